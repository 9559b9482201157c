#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Accelerated projected gradient on the dual problem (dual_problem.hpp): Nesterov's momentum with restart,
///
///     gamma+ = P_B(x - B^-1 g(x) / L),   x+ = gamma+ + beta (gamma+ - gamma)
///
/// L found by backtracking and relaxed by 10 % per step; momentum is dropped where it points uphill. Mazhar,
/// Heyn, Negrut, Tasora (2015), "Using Nesterov's method to accelerate multibody dynamics with friction and
/// contact", algorithm 1; we differ in the preconditioning metric B, and in returning the iterate of
/// least f.
///
/// Stops when dual_accuracy <= tolerance. Default of max_iterations: 5000. Cost per iteration: one product
/// with N per trial of L.
SolveSummary solve_apgd(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution);

}  // namespace cupola
