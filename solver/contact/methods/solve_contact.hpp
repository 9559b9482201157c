#pragma once

#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves contact problems of any compliance (zero included), friction law and method. Keeps the ordering and
/// the symbolic and numeric factor between calls.
///
/// Convex problems (associated law, all E > 0) go straight to the method (method_table.hpp). Zero compliance
/// with a primal method, and Coulomb's law with every method, take outer iterations (outer_iterations.hpp).
/// Where these stall under Coulomb's law, coulomb_newton.hpp takes over. A given max_iterations excludes all
/// second attempts.
class ContactSolver {
 public:
  SolveSummary solve(const ContactProblem& problem, const ContactSolverOptions& options,
                     ContactSolution* solution);

 private:
  NewtonSolver newton_;
};

/// A single solve; nothing is kept.
SolveSummary solve_contact(const ContactProblem& problem, const ContactSolverOptions& options,
                           ContactSolution* solution);

}  // namespace cupola
