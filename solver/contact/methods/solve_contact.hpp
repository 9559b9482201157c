#pragma once

#include "assembly/model/choices.hpp"
#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

struct ContactSolverOptions : SolveOptions {
  ContactMethod method = ContactMethod::newton;
  FrictionLaw law = FrictionLaw::associated;
};

/// Solves contact problems of any compliance (zero included), friction law and method, and keeps between
/// calls what a method can use again (ordering, symbolic and numeric factor).
///
/// newton: where the plain method does not converge within 25 iterations, interior point and Newton from
/// there. Zero compliance (newton, interior_point) and the Coulomb law (all) go through outer_iterations.hpp;
/// where the passes of the Coulomb law stall, coulomb_newton.hpp is asked.
class ContactSolver {
 public:
  SolveSummary solve(const ContactProblem& problem, const ContactSolverOptions& options,
                     ContactSolution* solution);

 private:
  NewtonSolver newton_;
};

/// One solve without a past.
SolveSummary solve_contact(const ContactProblem& problem, const ContactSolverOptions& options,
                           ContactSolution* solution);

}  // namespace cupola
