#include "solver/contact/methods/solve_contact.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "assembly/base/error.hpp"
#include "solver/contact/methods/method_table.hpp"
#include "solver/contact/methods/outer_iterations.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"

namespace cupola {

namespace {

/// Compliances below this share of their Delassus block get a proximal term: below it, Newton's impulses lose
/// more digits to rounding than the tolerance permits.
constexpr double kProximalShare = 1e-4;
constexpr double kLargestRoundingResidual = 1e-2;  // a larger momentum residual is not due to rounding
constexpr int kRescueOuterIterations = 80;  // a dome that slides on 1e-14 m/N takes more than 40 at times

/// Blocks at rest under the impulses of the guess, if their residuals are those of a solution. Many impulses
/// of rigid contacts balance the same loads, so that any others would be no better. The momentum residual
/// alone excludes most motions, at a tenth of the cost.
std::optional<SolveSummary> keep_at_rest(const ContactProblem& problem, const ContactSolverOptions& options,
                                         ContactSolution* solution) {
  if (solution->gamma.size() != problem.b.size()) return std::nullopt;
  ContactSolution rest{VecX::Zero(problem.v_star.size()), solution->gamma};
  if (!(momentum_residual(problem, rest, options.reference_speed) <= options.tolerance)) return std::nullopt;
  const Residuals residuals = compute_residuals(problem, rest, options.reference_speed, options.law);
  if (!(excess(residuals, options.tolerance) <= 1.0)) return std::nullopt;
  *solution = std::move(rest);
  SolveSummary summary;
  summary.ending = SolveEnding::converged;
  summary.measure = ErrorMeasure::all_residuals;
  summary.reached = largest_residual(residuals);
  summary.residual_history = {summary.reached};
  summary.message =
      residuals_text(residuals, options.tolerance) + ", at rest under the impulses of the last step";
  return summary;
}

}  // namespace

/// Newton from where De Saxce's iterations lead. Under Coulomb's law.
SolveSummary ContactSolver::solve_from_nearer(const ContactProblem& problem,
                                              const ContactSolverOptions& options,
                                              ContactSolution* solution) {
  constexpr double kNear = 1e-3;  // where few contacts change their state
  constexpr int kMost = 12;       // steps of a vault near collapse that get there take 2 to 10
  ContactSolverOptions coarse = options;
  coarse.tolerance = std::max(kNear, options.tolerance);
  coarse.max_iterations.reset();
  const auto convex = [this](const ContactProblem& p, const SolveOptions& o, ContactSolution* x) {
    return newton_.solve(p, o, x);
  };
  const SolveSummary nearer = solve_by_outer_iterations(problem, {coarse, 0.0, kMost}, convex, solution);
  if (nearer.ending != SolveEnding::converged) return nearer;
  return coulomb_.solve(problem, options, solution).after(nearer);
}

SolveSummary ContactSolver::solve(const ContactProblem& problem, const ContactSolverOptions& options,
                                  ContactSolution* solution) {
  const bool rigid = first_rigid_contact(problem).has_value();
  if (rigid && options.try_rest) {
    options.validate();
    if (problem.defect().empty())
      if (std::optional<SolveSummary> rest = keep_at_rest(problem, options, solution)) return *rest;
  }
  const MethodTraits& method = method_traits(options.method);
  const auto convex = [&](const ContactProblem& p, const SolveOptions& o, ContactSolution* x) {
    const SolveSummary summary = method.solve(newton_, p, o, x);
    CUPOLA_ASSERT(!summary.usable() || (x->v.size() == p.v_star.size() && x->gamma.size() == p.b.size()));
    CUPOLA_ASSERT(!summary.usable() || (x->v.allFinite() && x->gamma.allFinite()));
    return summary;
  };
  if (!rigid && options.law.is_associated()) {
    SolveSummary first = convex(problem, options, solution);
    if (!first.usable() || first.ending == SolveEnding::converged || !method.primal) return first;
    if (options.max_iterations) return first;  // the limit of the caller
    // Where blocks slide on tiny compliance, impulses are smaller than the rounding of D^T v / E. And a
    // problem that defeats both methods is easier with a larger compliance that is then removed stepwise.
    const bool near =
        !first.residual_history.empty() && first.residual_history.back() < kLargestRoundingResidual;
    ContactSolution polished = near ? *solution : ContactSolution{};
    SolveSummary last = solve_by_outer_iterations(problem, {options, kProximalShare, kRescueOuterIterations},
                                                  convex, &polished);
    const bool better = last.usable() && last.residual_history.back() < first.residual_history.back();
    if (last.ending != SolveEnding::converged && !better) return first;
    *solution = polished;
    return last.after(first);
  }
  if (options.law.is_associated() && !method.primal) return convex(problem, options, solution);
  std::optional<SolveSummary> newton;
  if (!options.law.is_associated() && options.method == ContactMethod::newton) {
    ContactSolution x = *solution;
    newton = coulomb_.solve(problem, options, &x);
    if (newton->ending != SolveEnding::converged && options.near_solution && !rigid) {
      ContactSolution nearer = x;
      const SolveSummary last = solve_from_nearer(problem, options, &nearer);
      if (last.ending == SolveEnding::converged) {
        *solution = std::move(nearer);
        return last.after(*newton);
      }
      newton->add_work(last);
    }
    if (newton->ending == SolveEnding::converged || options.max_iterations) {
      *solution = std::move(x);
      return *newton;
    }
  }
  const double share = rigid && method.primal ? kProximalShare : 0.0;
  const SolveSummary last = solve_by_outer_iterations(problem, {options, share}, convex, solution);
  return newton ? last.after(*newton) : last;
}

SolveSummary solve_contact(const ContactProblem& problem, const ContactSolverOptions& options,
                           ContactSolution* solution) {
  return ContactSolver().solve(problem, options, solution);
}

}  // namespace cupola
