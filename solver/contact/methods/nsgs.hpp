#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Non-smooth Gauss-Seidel: one contact after the other, each solved exactly against the others' last
/// impulses (local_contact.hpp), in the order of the problem; velocities are updated in place, so a sweep
/// costs about as much as two products with N. Jean (1999), "The non-smooth contact dynamics method", section
/// 5; here for the associated law (Coulomb's goes through outer_iterations.hpp).
///
/// Stops when dual_accuracy <= tolerance (measured every tenth sweep), not when sweeps stop changing: small
/// changes are no equilibrium. Default of max_iterations: 5000 sweeps. Where E = 0 the forces depend on the
/// order.
SolveSummary solve_nsgs(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution);

}  // namespace cupola
