#pragma once

#include "solver/contact/methods/coulomb_newton.hpp"
#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves contact problems of any compliance (zero included), friction law and method. Keeps the ordering and
/// the symbolic and numeric factor between calls.
///
/// Convex problems (associated law, all E > 0) go straight to the method (method_table.hpp). All other flow
/// rules go to coulomb_newton.hpp if the method is Newton's. The other methods solve convex problems only:
/// they take De Saxce's outer iterations (outer_iterations.hpp), as do primal methods with zero compliance. A
/// given max_iterations excludes all second attempts.
class ContactSolver {
 public:
  SolveSummary solve(const ContactProblem& problem, const ContactSolverOptions& options,
                     ContactSolution* solution);

 private:
  SolveSummary solve_from_nearer(const ContactProblem& problem, const ContactSolverOptions& options,
                                 ContactSolution* solution);

  NewtonSolver newton_;
  CoulombNewton coulomb_;
};

/// A single solve; nothing is kept.
SolveSummary solve_contact(const ContactProblem& problem, const ContactSolverOptions& options,
                           ContactSolution* solution);

}  // namespace cupola
