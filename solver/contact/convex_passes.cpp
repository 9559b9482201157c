#include "solver/contact/convex_passes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/program.hpp"
#include "solver/contact/anderson.hpp"
#include "solver/contact/residuals.hpp"

namespace cupola {

namespace {

/// Proximal compliance R (3 nc) of the contacts that need one.
VecX proximal_compliance(const ContactProblem& p, double share) {
  VecX R = VecX::Zero(p.E.size());
  if (share == 0.0) return R;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const double wanted = share * delassus_trace(p, i) / 3.0;
    R.segment<3>(3 * i) = (wanted - p.E.segment<3>(3 * i).array()).cwiseMax(0.0);
  }
  return R;
}

/// b' - b = s n - R gamma at the pair (v, gamma), with De Saxce's s = mu |y_t|, y = D^T v + b + E gamma (3
/// nc).
VecX shift_at(const ContactProblem& p, const ContactSolution& x, const VecX& R, FrictionLaw law) {
  VecX shift = -R.cwiseProduct(x.gamma);
  if (law == FrictionLaw::associated) return shift;
  const VecX y = relative_velocity(p, x.v) + p.b + p.E.cwiseProduct(x.gamma);
  for (int i = 0; i < p.num_contacts(); ++i) shift[3 * i] += p.mu[i] * y.segment<2>(3 * i + 1).norm();
  return shift;
}

/// Worst of the two residuals over what can be asked of it: <= 1 ends the passes.
double excess(const Residuals& r, double tolerance) {
  constexpr double kRoundingMargin = 16.0;  // several roundings add up
  return std::max(r.momentum / tolerance,
                  r.contact_law / std::max(tolerance, kRoundingMargin * r.contact_law_rounding));
}

void add_counts(const SolveSummary& pass, SolveSummary* total) {
  total->iterations += pass.iterations;
  total->factorizations += pass.factorizations;
  total->conjugate_gradients += pass.conjugate_gradients;
  total->line_search_evaluations += pass.line_search_evaluations;
}

}  // namespace

SolveSummary solve_in_passes(const ContactProblem& problem, const SolveOptions& options,
                             const PassOptions& passes, const ConvexSolve& solve, ContactSolution* solution) {
  constexpr int kDepth = 10;     // differences that Anderson combines
  constexpr int kPatience = 80;  // passes without a new best before giving up
  constexpr int kRetry = 16;     // passes without a new best before Anderson starts afresh
  const double start = wall_seconds();
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;

  const VecX R = proximal_compliance(problem, passes.proximal_share);
  ContactProblem convex = problem;
  convex.E += R;
  ContactSolution x = *solution;
  if (x.gamma.size() != problem.b.size()) x.gamma = VecX::Zero(problem.b.size());
  if (x.v.size() != problem.v_star.size()) x.v = VecX(0);
  VecX shift = VecX::Zero(problem.b.size());
  if (x.v.size() > 0) shift = shift_at(problem, x, R, passes.law);
  Anderson anderson(kDepth);
  SolveOptions inner = options;
  inner.tolerance = 0.5 * options.tolerance;

  double best = std::numeric_limits<double>::infinity();
  Residuals best_residuals;
  int best_pass = 0, pass = 0;
  while (best > 1.0 && pass < passes.max_passes && pass - best_pass < kPatience) {
    ++pass;
    convex.b = problem.b + shift;
    const SolveSummary solved = solve(convex, inner, &x);
    add_counts(solved, &summary);
    if (!solved.usable()) {
      summary.message = fmt::format("pass {}: {}", pass, solved.message);
      break;
    }
    const Residuals residuals = compute_residuals(problem, x, options.reference_speed, passes.law);
    summary.residual_history.push_back(std::max(residuals.momentum, residuals.contact_law));
    if (const double now = excess(residuals, options.tolerance); now < best) {
      best = now;
      best_pass = pass;
      best_residuals = residuals;
      *solution = x;
    }
    const VecX next = shift_at(problem, x, R, passes.law);
    if ((pass - best_pass) % kRetry == kRetry - 1) anderson.forget();
    // The proximal map contracts by itself where it matters; only De Saxce's is worth accelerating.
    shift = passes.law == FrictionLaw::coulomb ? anderson.next(shift, next) : next;
  }
  summary.passes = pass;
  summary.time_seconds = wall_seconds() - start;
  if (best_pass == 0) return summary;  // failed in the first pass
  summary.ending = best <= 1.0                 ? SolveEnding::converged
                   : pass >= passes.max_passes ? SolveEnding::max_iterations
                                               : SolveEnding::stalled;
  summary.message =
      fmt::format("momentum residual {:.2e}, contact-law residual {:.2e}, tolerance {:.2e} after {} passes",
                  best_residuals.momentum, best_residuals.contact_law, options.tolerance, pass);
  return summary;
}

}  // namespace cupola
