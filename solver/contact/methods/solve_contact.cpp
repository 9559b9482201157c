#include "solver/contact/methods/solve_contact.hpp"

#include "solver/contact/methods/coulomb_newton.hpp"
#include "solver/contact/methods/method_table.hpp"
#include "solver/contact/methods/outer_iterations.hpp"

namespace cupola {

namespace {

/// Below this share of its Delassus block a compliance leaves Newton's impulses fewer digits than asked for.
constexpr double kProximalShare = 1e-4;
constexpr double kNearRounding = 1e-2;  // a momentum residual above this is no rounding
constexpr int kRescueOuterIterations = 40;

bool has_rigid_contact(const ContactProblem& p) {
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (p.E[3 * i] == 0.0 || (p.mu[i] > 0.0 && p.E[3 * i + 1] == 0.0)) return true;
  }
  return false;
}

}  // namespace

SolveSummary ContactSolver::solve(const ContactProblem& problem, const ContactSolverOptions& options,
                                  ContactSolution* solution) {
  const bool rigid = has_rigid_contact(problem);
  const MethodTraits& method = method_traits(options.method);
  const auto convex = [&](const ContactProblem& p, const SolveOptions& o, ContactSolution* x) {
    return method.solve(newton_, p, o, x);
  };
  if (!rigid && options.law == FrictionLaw::associated) {
    SolveSummary first = convex(problem, options, solution);
    if (!first.usable() || first.ending == SolveEnding::converged || !method.primal) return first;
    if (options.max_iterations) return first;  // the caller has set a limit to the work
    // Sliding on tiny compliance leaves impulses below the rounding of D^T v / E; and what defeats both
    // methods is easier on a larger compliance that is then taken away.
    const bool near = !first.residual_history.empty() && first.residual_history.back() < kNearRounding;
    ContactSolution polished = near ? *solution : ContactSolution{};
    SolveSummary last = solve_by_outer_iterations(
        problem, options, {options.law, kProximalShare, kRescueOuterIterations}, convex, &polished);
    const bool better = last.usable() && last.residual_history.back() < first.residual_history.back();
    if (last.ending != SolveEnding::converged && !better) return first;
    *solution = polished;
    return last.after(first);
  }
  SolveSummary summary;
  if (options.law == FrictionLaw::associated && !method.primal) {
    summary = convex(problem, options, solution);
  } else {
    const double share = rigid && method.primal ? kProximalShare : 0.0;
    summary = solve_by_outer_iterations(problem, options, {options.law, share}, convex, solution);
  }
  const bool in_circles = options.law == FrictionLaw::coulomb && summary.ending == SolveEnding::stalled;
  if (in_circles && !options.max_iterations) {
    ContactSolution again = *solution;
    SolveSummary last = solve_coulomb_newton(problem, options, &again);
    if (last.ending == SolveEnding::converged) {
      *solution = again;
      summary = last.after(summary);
    }
  }
  if (rigid && summary.usable()) summary.message += "; some compliance is zero: forces are not unique";
  return summary;
}

SolveSummary solve_contact(const ContactProblem& problem, const ContactSolverOptions& options,
                           ContactSolution* solution) {
  return ContactSolver().solve(problem, options, solution);
}

}  // namespace cupola
