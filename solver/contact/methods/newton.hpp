#pragma once

#include "solver/contact/methods/newton_direction.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// True if multigrid-preconditioned CG is faster than Cholesky: 10,000 blocks or more, not plane. With
/// multigrid a static solve takes two thirds of the time at 11,568 blocks and two fifths at 82,048, and the
/// first steps of a collapse of 11,568 blocks a quarter. In the plane factors are small.
bool has_many_blocks(const ContactProblem& problem);

/// Default of max_iterations.
constexpr int kNewtonIterations = 100;

/// Iterations within which nearly every problem that converges has converged: 25, or 60 with multigrid.
/// Typical are 4 to 20 with Cholesky factors, and 10 to 30 cheaper ones with multigrid.
int usual_newton_iterations(const ContactProblem& problem);

/// Primal semismooth Newton method for the associated law, all E > 0. Minimises the cost of primal_cost.hpp
/// in the whitened velocities w = L^T v:
///
///     (I + J G(w) J^T) d = -gradient,   w <- w + t d,   t by line search
///
/// after Castro, Permenter, Han (2022), "An unconstrained convex formulation of compliant contact" (SAP). We
/// differ in using the exact cone projection with its kinks (no smoothing of friction), in whitening with
/// full 6x6 blocks, and in the cold start, which is the solution with all contacts sticking.
///
/// With many blocks (has_many_blocks) multigrid-preconditioned conjugate gradients replace the factorisation.
/// They serve statics and motions, and reduce the residual to a tenth at first and further as Newton
/// converges (Eisenstat and Walker 1996). If they fail, the direction comes from a factor. A sweep of
/// BlockDescent follows every step with multigrid, and with factors every step from the tenth on; otherwise a
/// few contacts that still change their region would delay the whole structure.
///
/// The solver object keeps the ordering and the symbolic factor while the same pairs of blocks touch.
///
/// `tolerance` bounds Residuals::momentum. 1e-10 gives equilibrium to ten digits; below about 1e-13 rounding
/// prevents convergence.
///
/// Endings:
///   converged        momentum residual <= tolerance; gamma = gamma(v) obeys the contact law exactly
///   stalled          neither cost nor residual decreases any further in double precision
///   max_iterations   the limit was reached
///   failed           invalid input or zero compliance (see the message), or the factorisation broke down
/// The solution is the iterate with the smallest residual; after `failed` it is invalid.
class NewtonSolver {
 public:
  /// `solution`: on entry the initial velocities (empty: cold start), on exit the solution.
  SolveSummary solve(const ContactProblem& problem, const SolveOptions& options, ContactSolution* solution);

 private:
  NewtonDirection direction_;
};

}  // namespace cupola
