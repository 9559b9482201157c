#pragma once

#include <optional>

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// Second derivative of the energy at an equilibrium, in whitened unknowns: the stiffness of the joints plus
/// the geometric stiffness of the contact forces, which act on points that rotate with their blocks.
class SwayStiffness {
 public:
  /// Keeps references to `white` and `graph`. `impulses`: of the equilibrium, N s (3 nc). `slowest`: growth
  /// rate squared times h squared that counts as none.
  SwayStiffness(const WhitenedProblem& white, const ContactGraph& graph, const VecX& impulses,
                double slowest);

  /// With the stiffness G of each contact, kg; positive definite up to the slowest growth and rounding.
  BlockMatrix matrix(const std::vector<Mat3>& G) const;

  /// True if motions in both senses along each negative direction close open joints that make it positive:
  /// the structure sways until they close, and rests on them.
  bool joints_end_sway(const std::vector<Mat3>& G) const;

 private:
  double smallest(const BlockMatrix& H) const;  ///< stiffness that counts as positive
  /// A motion whose curvature is negative; none if the matrix is positive definite.
  std::optional<VecX> negative_direction(const std::vector<Mat3>& G) const;
  bool joints_end_sway(std::vector<Mat3> G, VecX direction) const;

  const WhitenedProblem& white_;
  const ContactGraph& graph_;
  const double slowest_;
  std::vector<Mat6> geometric_;  ///< of each block
};

}  // namespace cupola
