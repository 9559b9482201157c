#pragma once

#include "solver/contact/block_cholesky.hpp"
#include "solver/contact/contact_problem.hpp"
#include "solver/contact/solve_summary.hpp"

namespace cupola {

struct NewtonOptions {
  /// Stops when Residuals::momentum <= tolerance (relative unbalanced impulse, no unit), in (0, 1). 1e-10
  /// leaves equilibrium exact to ten digits; below about 1e-13 rounding is met first and the ending is
  /// `stalled`.
  double tolerance = 1e-10;
  double reference_speed = 0.0;  ///< m/s, > 0: h |g|, makes the momentum residual relative
  int max_iterations = 100;      ///< >= 1; a hundred factorisations without an answer call for interior_point
  void validate() const;         ///< throws std::invalid_argument with name, value and rule
};

/// Primal semismooth Newton for the associated law, all E > 0. Minimises the cost of primal_cost.hpp in the
/// whitened velocities w = L^T v:
///
///     (I + J G(w) J^T) d = -gradient,   w <- w + t d,   t by exact line search
///
/// after Castro, Permenter, Han (2022), "An unconstrained convex formulation of compliant contact" (SAP). We
/// differ in using the exact cone projection with its kinks (no smoothing of friction), in whitening with
/// full 6x6 blocks, and in starting cold from the solve in which every closed contact sticks.
///
/// The solver object keeps ordering and symbolic factor while the same pairs of blocks touch.
///
/// Endings: `converged`: momentum residual <= tolerance, and gamma = gamma(v) meets the contact law exactly;
/// `stalled`: neither cost nor residual falls any more in double precision; `max_iterations`; `failed`: the
/// input is unsound (message says what), some compliance is zero, or the factorisation broke down. The answer
/// is always the iterate with the smallest residual; only after `failed` it must not be used.
class NewtonSolver {
 public:
  /// `solution`: velocities to start from (empty: cold start); on exit the answer.
  SolveSummary solve(const ContactProblem& problem, const NewtonOptions& options, ContactSolution* solution);

 private:
  BlockCholesky factor_;
};

}  // namespace cupola
