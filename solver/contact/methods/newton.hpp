#pragma once

#include "solver/contact/methods/newton_direction.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// True if multigrid-preconditioned CG is faster than Cholesky: 10,000 blocks or more, not plane. With multigrid
/// a static solve takes two thirds of the time at 11,568 blocks and two fifths at 82,048. In the plane factors
/// are small.
bool has_many_blocks(const ContactProblem& problem);

/// Default of max_iterations.
constexpr int kNewtonIterations = 100;

/// Iterations within which nearly every problem that converges has converged: 25, or 60 with multigrid. Typical
/// are 4 to 20 with Cholesky factors, and 10 to 30 cheaper ones with multigrid.
int usual_newton_iterations(const ContactProblem& problem);

/// Primal semismooth Newton for the associated law, all E > 0. Minimises the cost of primal_cost.hpp in the
/// whitened velocities w = L^T v:
///
///     (I + J G(w) J^T) d = -gradient,   w <- w + t d,   t by exact line search
///
/// after Castro, Permenter, Han (2022), "An unconstrained convex formulation of compliant contact" (SAP). We
/// differ in using the exact cone projection with its kinks (no smoothing of friction), in whitening with
/// full 6x6 blocks, and in starting cold from the solve in which every closed contact sticks.
///
/// Of many blocks a factorisation costs far more than conjugate gradients with a hierarchy of groups of
/// blocks (Multigrid), to a tenth at first and to more digits as the iterations close in (Eisenstat and
/// Walker 1996); where they fail a factor is made after all. And after every step the blocks settle one by
/// one (BlockDescent): of a million bricks a few that still change would otherwise hold up all others.
///
/// The solver object keeps ordering and symbolic factor while the same pairs of blocks touch.
///
/// `tolerance` bounds Residuals::momentum. 1e-10 leaves equilibrium exact to ten digits; below about 1e-13
/// rounding is met first.
///
/// Endings: `converged`: momentum residual <= tolerance, and gamma = gamma(v) meets the contact law exactly;
/// `stalled`: neither cost nor residual falls any more in double precision; `max_iterations`; `failed`: the
/// input is unsound (message says what), some compliance is zero, or the factorisation broke down. The answer
/// is always the iterate with the smallest residual; only after `failed` it must not be used.
class NewtonSolver {
 public:
  /// `solution`: velocities to start from (empty: cold start); on exit the answer.
  SolveSummary solve(const ContactProblem& problem, const SolveOptions& options, ContactSolution* solution);

 private:
  NewtonDirection direction_;
};

}  // namespace cupola
