#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Accelerated projected gradient descent (APGD) on the dual problem (dual_problem.hpp), Nesterov's momentum
/// with restarts:
///
///     gamma+ = P_B(x - B^-1 g(x) / L),   x+ = gamma+ + beta (gamma+ - gamma)
///
/// L is found by back-tracking and reduced by 10 % per step. Momentum is dropped where it points uphill.
/// Mazhar, Heyn, Negrut, Tasora (2015), "Using Nesterov's method to accelerate multibody dynamics with
/// friction and contact", algorithm 1. We differ in the preconditioning metric B, and in returning the most
/// accurate iterate.
///
/// Converged when dual_accuracy <= tolerance. Default of max_iterations: 5000. Cost per iteration: one
/// product with N per trial value of L.
SolveSummary solve_apgd(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution);

}  // namespace cupola
