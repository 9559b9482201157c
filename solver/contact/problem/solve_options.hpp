#pragma once

#include <optional>

#include "assembly/model/choices.hpp"
#include "solver/contact/problem/flow_rule.hpp"

namespace cupola {

/// Options that every method takes.
struct SolveOptions {
  /// The method has converged when its measure <= tolerance. In (0, 1), no unit. The measure is the momentum
  /// residual for newton, the force error bound or (zero compliance) the contact-law residual for spg, apgd
  /// and nsgs, and the largest residual for admm and outer iterations. SolveSummary names it.
  double tolerance = 1e-10;
  /// m/s, > 0: h |g|, the speed that a free block gains in the step. Makes residuals relative.
  double reference_speed = 0.0;
  std::optional<int> max_iterations;  ///< >= 1; none: the default of the method
  /// Newton only: directions by multigrid-preconditioned conjugate gradients; none: if has_many_blocks()
  /// (newton.hpp).
  std::optional<bool> multigrid;
  /// Newton without multigrid only: keep the factor from step to step as the preconditioner of conjugate
  /// gradients, and renew it when they need more than 25 iterations. Faster while few contacts change state,
  /// at the same accuracy.
  bool lag_factor = false;
  /// Newton under Coulomb's law only: the guess is near a solution. Directions that do not reduce the residual
  /// are repeated with a damped matrix, and where Newton fails some of De Saxce's iterations bring the guess
  /// nearer. Worth it where a failed solve is dear; along a path a shorter step mostly is cheaper.
  bool near_solution = false;

  /// Throws std::invalid_argument with name, value and rule.
  void validate() const;
};

/// Options of a contact problem of any friction law, solved by a given method.
struct ContactSolverOptions : SolveOptions {
  ContactMethod method = ContactMethod::newton;
  FlowRule law;
  /// Rigid contacts only: try first whether blocks at rest under the impulses of the guess are the solution.
  /// For time steps, in which a structure at rest then keeps its impulses.
  bool try_rest = false;
};

}  // namespace cupola
