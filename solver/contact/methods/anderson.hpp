#pragma once

#include <deque>

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Anderson acceleration of a fixed-point iteration x <- g(x): the next point is the combination of the last
/// few g(x_j) whose residuals g(x_j) - x_j combine to the least norm. It turns linear convergence at rate q
/// near 1 into something like a Krylov method's, and costs a small least-squares problem per pass. Walker, Ni
/// (2011), "Anderson acceleration for fixed-point iterations", algorithm AA.
class Anderson {
 public:
  explicit Anderson(int depth) : depth_(depth) {}

  /// Next point, given x and g(x). Forgets the past when the residual grows above ten times the smallest
  /// seen.
  VecX next(const VecX& x, const VecX& g);
  void forget();

 private:
  int depth_;
  std::deque<VecX> dg_, df_;  ///< differences of g and of the residual between passes
  VecX last_g_, last_f_;
  double smallest_residual_ = 0.0;
};

}  // namespace cupola
