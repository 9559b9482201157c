#pragma once

#include "assembly/model/choices.hpp"
#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Everything the solver knows about a contact method: one row of the table in method_table.cpp. The names of
/// the methods in files are in assembly/model/choices.hpp.
struct MethodTraits {
  ContactMethod method;
  /// True: minimises over velocities. The impulses follow from them by the contact law, so every contact
  /// needs a compliance > 0; rigid ones get a proximal term (outer_iterations.hpp). False: minimises over
  /// impulses and accepts any compliance >= 0.
  bool primal;
  bool uses_factor;  ///< factorises a Hessian with the pattern of the contact graph
  /// Solves problems of many blocks (has_many_blocks) by multigrid-preconditioned CG instead of a factor.
  bool uses_multigrid;
  /// Solves the convex (associated) problem: guess in, solution out. `newton` keeps its ordering and factor
  /// between calls; methods that do not use it ignore it.
  SolveSummary (*solve)(NewtonSolver& newton, const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution);
};

const MethodTraits& method_traits(ContactMethod method);

/// Interior point to a complementarity of 1e-7 of the elastic work, then Newton from there.
SolveSummary solve_interior_point_then_newton(NewtonSolver& newton, const ContactProblem& problem,
                                              const SolveOptions& options, ContactSolution* solution);

/// Newton; where it does not converge within usual_newton_iterations(), interior point and Newton from there.
/// Returns the better of the two solutions.
SolveSummary solve_newton_with_fallback(NewtonSolver& newton, const ContactProblem& problem,
                                        const SolveOptions& options, ContactSolution* solution);

}  // namespace cupola
