#pragma once

#include <optional>

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// The exact impulses are gamma + correction + rest with |rest|_E <= remainder.
struct ForceErrorBound {
  VecX correction;         ///< N s (3 nc)
  double remainder = 0.0;  ///< sqrt(J)
};

/// Linear algebra of certify_static() (static_certificate.hpp) on one contact problem.
class ForceProjection {
 public:
  /// `impulse`: h times the loads, N s, N m s (6 nb).
  ForceProjection(const ContactProblem& problem, VecX impulse);

  /// True if some loaded contact is on the boundary of its friction cone.
  bool slides(const ContactSolution& x) const;

  /// True if stiffness of the joints plus geometric stiffness is positive definite up to a growth rate of
  /// sqrt(1e-3 gravity / m), as it is or with the joints closed that its negative directions close.
  bool is_stable(const ContactSolution& x, double gravity);

  /// True if impulses in exact equilibrium next to those of x are proven to exist (exact_equilibrium.hpp).
  /// Replaces the factor that the other functions share: call it last.
  bool proves_equilibrium(const ContactSolution& x);

  /// Bounds the distance of the impulses from those of the exact static solution. None if no forces in the
  /// cones that balance the loads are found next to gamma. Requires all E > 0 and the associated law.
  std::optional<ForceErrorBound> force_error(const ContactSolution& x);

 private:
  std::vector<Mat3> stiffnesses(const ContactSolution& x) const;
  Mat3 tangent(const ContactSolution& x, int contact) const;
  std::vector<Mat3> tangents(const ContactSolution& x) const;
  std::optional<ContactSolution> correction(const std::vector<Mat3>& S, const VecX& imbalance,
                                            double reduction);

  const ContactProblem& p_;
  const VecX impulse_;
  const WhitenedProblem white_;
  const ContactGraph graph_;
  BlockCholesky preconditioner_;
};

}  // namespace cupola
