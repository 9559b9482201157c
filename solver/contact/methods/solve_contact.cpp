#include "solver/contact/methods/solve_contact.hpp"

#include <algorithm>

#include "solver/contact/methods/admm.hpp"
#include "solver/contact/methods/apgd.hpp"
#include "solver/contact/methods/convex_passes.hpp"
#include "solver/contact/methods/coulomb_newton.hpp"
#include "solver/contact/methods/interior_point.hpp"
#include "solver/contact/methods/nsgs.hpp"
#include "solver/contact/methods/spg.hpp"

namespace cupola {

namespace {

/// Below this share of its Delassus block a compliance leaves Newton's impulses fewer digits than asked for.
constexpr double kProximalShare = 1e-4;
constexpr double kNearRounding = 1e-2;  // a momentum residual above this is no rounding
constexpr int kRescuePasses = 40;

bool has_rigid_contact(const ContactProblem& p) {
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (p.E[3 * i] == 0.0 || (p.mu[i] > 0.0 && p.E[3 * i + 1] == 0.0)) return true;
  }
  return false;
}

/// The later of two runs on one problem, with the work of both.
SolveSummary combined(const SolveSummary& first, SolveSummary last) {
  last.iterations += first.iterations;
  last.factorizations += first.factorizations;
  last.conjugate_gradients += first.conjugate_gradients;
  last.line_search_evaluations += first.line_search_evaluations;
  last.time_seconds += first.time_seconds;
  last.residual_history.insert(last.residual_history.begin(), first.residual_history.begin(),
                               first.residual_history.end());
  return last;
}

}  // namespace

SolveSummary ContactSolver::interior_point_then_newton(const ContactProblem& problem,
                                                       const SolveOptions& options,
                                                       ContactSolution* solution) {
  constexpr double kHandOver =
      1e-7;  // complementarity over elastic work: Newton then finds its last few active sets
  SolveOptions near = options;
  near.tolerance = kHandOver;
  near.max_iterations = 0;
  SolveSummary first = solve_interior_point(problem, near, solution);
  if (!first.usable()) return first;
  SolveSummary last = combined(first, newton_.solve(problem, options, solution));
  last.message = "interior point, then Newton: " + last.message;
  return last;
}

SolveSummary ContactSolver::newton_with_fall_back(const ContactProblem& problem, const SolveOptions& options,
                                                  ContactSolution* solution) {
  const int plain_iterations = iterations_of_sound_problem(problem);  // interior point takes about 27
  SolveOptions plain = options;
  const int limit = options.max_iterations > 0 ? options.max_iterations : 100;
  plain.max_iterations = std::min(limit, plain_iterations);
  SolveSummary first = newton_.solve(problem, plain, solution);
  if (first.ending != SolveEnding::max_iterations || limit <= plain_iterations) return first;
  ContactSolution again;
  SolveSummary last = combined(first, interior_point_then_newton(problem, options, &again));
  if (!last.usable() || last.residual_history.back() > first.residual_history.back()) return first;
  *solution = again;
  return last;
}

SolveSummary ContactSolver::solve_convex(const ContactProblem& problem, const SolveOptions& options,
                                         ContactMethod method, ContactSolution* solution) {
  switch (method) {
    case ContactMethod::newton:
      return newton_with_fall_back(problem, options, solution);
    case ContactMethod::interior_point:
      return interior_point_then_newton(problem, options, solution);
    case ContactMethod::spg:
      return solve_spg(problem, options, solution);
    case ContactMethod::apgd:
      return solve_apgd(problem, options, solution);
    case ContactMethod::nsgs:
      return solve_nsgs(problem, options, solution);
    case ContactMethod::admm:
      return solve_admm(problem, options, solution);
  }
  return {};
}

SolveSummary ContactSolver::solve(const ContactProblem& problem, const ContactSolverOptions& options,
                                  ContactSolution* solution) {
  const bool rigid = has_rigid_contact(problem);
  const bool primal =
      options.method == ContactMethod::newton || options.method == ContactMethod::interior_point;
  const auto convex = [&](const ContactProblem& p, const SolveOptions& o, ContactSolution* x) {
    return solve_convex(p, o, options.method, x);
  };
  if (!rigid && options.law == FrictionLaw::associated) {
    SolveSummary first = convex(problem, options, solution);
    if (!first.usable() || first.ending == SolveEnding::converged || !primal) return first;
    if (options.max_iterations > 0) return first;  // the caller has set a limit to the work
    // Sliding on tiny compliance leaves impulses below the rounding of D^T v / E; and what defeats both
    // methods is easier on a larger compliance that is then taken away.
    const bool near = !first.residual_history.empty() && first.residual_history.back() < kNearRounding;
    ContactSolution polished = near ? *solution : ContactSolution{};
    SolveSummary last =
        solve_in_passes(problem, options, {options.law, kProximalShare, kRescuePasses}, convex, &polished);
    const bool better = last.usable() && last.residual_history.back() < first.residual_history.back();
    if (last.ending != SolveEnding::converged && !better) return first;
    *solution = polished;
    return combined(first, last);
  }
  SolveSummary summary;
  if (options.law == FrictionLaw::associated && !primal) {
    summary = convex(problem, options, solution);
  } else {
    const double share = rigid && primal ? kProximalShare : 0.0;
    summary = solve_in_passes(problem, options, {options.law, share}, convex, solution);
  }
  const bool in_circles = options.law == FrictionLaw::coulomb && summary.ending == SolveEnding::stalled;
  if (in_circles && options.max_iterations == 0) {
    ContactSolution again = *solution;
    SolveSummary last = solve_coulomb_newton(problem, options, &again);
    if (last.ending == SolveEnding::converged) {
      *solution = again;
      summary = combined(summary, last);
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
