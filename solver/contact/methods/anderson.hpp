#pragma once

#include <deque>

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Anderson acceleration of a fixed-point iteration x <- g(x). The next point is the combination of the last
/// few g(x_j) whose combined residual g(x_j) - x_j has the least norm. Linear convergence at a rate near 1
/// becomes similar to that of a Krylov method, at the cost of a small least-squares problem per iteration.
/// Walker, Ni (2011), "Anderson acceleration for fixed-point iterations", algorithm AA.
class Anderson {
 public:
  explicit Anderson(int depth) : depth_(depth) {}

  /// Next point, given x and g(x). Restarts when the residual exceeds ten times the smallest one so far.
  VecX next(const VecX& x, const VecX& g);
  /// Forgets all points: the next ones may be of another map.
  void restart();

 private:
  int depth_;
  std::deque<VecX> dg_, df_;  ///< differences of g and of the residual between iterations
  VecX last_g_, last_f_;
  double smallest_residual_ = 0.0;
};

}  // namespace cupola
