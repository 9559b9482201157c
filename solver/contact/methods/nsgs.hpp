#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Non-smooth Gauss-Seidel (NSGS): solves the contacts one after another in the order of the problem, each
/// exactly for the current impulses of the others (local_contact.hpp). Velocities are updated in place, so a
/// sweep costs about two products with N. Jean (1999), "The non-smooth contact dynamics method", section 5;
/// here for the associated law (Coulomb's law: outer_iterations.hpp).
///
/// Converged when dual_accuracy <= tolerance, measured every tenth sweep. Small changes per sweep are no
/// stopping criterion, because they do not imply equilibrium. Default of max_iterations: 5000 sweeps. Where E
/// = 0 the forces depend on the order of the contacts.
SolveSummary solve_nsgs(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution);

}  // namespace cupola
