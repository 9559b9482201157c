#include "solver/contact/methods/coulomb_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/process.hpp"
#include "solver/contact/methods/coulomb_direction.hpp"
#include "solver/contact/methods/coulomb_subproblem.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {

namespace {

double largest_block(const VecX& F) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < F.size(); k += 6) {
    const double norm = F.segment<6>(k).norm();
    if (!(norm <= largest)) largest = norm;  // keeps NaN
  }
  return largest;
}

/// How accurately a subproblem is solved.
struct SubproblemAccuracy {
  double tolerance;                ///< of each block of F
  double share = 0.0;              ///< of the error that R causes; if larger, it replaces the tolerance
  bool inexact_directions = true;  ///< GMRES with an earlier factor where that succeeds
};

/// Semismooth Newton from `point`, with a line search on |F|. True if no block of F exceeds the tolerance;
/// otherwise point is the last iterate. Gives up where |F| has not halved in six iterations.
bool solve_subproblem(const CoulombSubproblem& sub, const SubproblemAccuracy& accuracy,
                      const SolveOptions& options, CoulombDirection* direction, CoulombPoint* point,
                      SolveSummary* summary) {
  constexpr int kMaxIterations = 30, kPatience = 6;
  constexpr double kShortest = 1.0 / 64.0, kDecrease = 1e-4;
  const int max_iterations = options.max_iterations.value_or(kMaxIterations);
  std::vector<double> norms;
  const auto is_solved = [&] {
    double tolerance = accuracy.tolerance;
    if (accuracy.share > 0.0)
      tolerance = std::max(tolerance, accuracy.share * sub.distance_to_centre(point->gamma));
    return largest_block(point->F) <= tolerance;
  };
  for (int k = 0; k < max_iterations && !is_solved(); ++k) {
    throw_if_interrupted();
    const VecX& F = point->F;
    norms.push_back(F.norm());
    if (k >= kPatience && norms[k] > 0.5 * norms[k - kPatience]) return false;
    ++summary->iterations;
    std::optional<double> forcing;
    if (accuracy.inexact_directions)
      forcing = std::clamp(0.3 * accuracy.tolerance / largest_block(F), 1e-2, 0.1);
    VecX d;
    if (!direction->solve(sub.p, sub.graph, sub.stiffnesses(point->y), F, forcing, &d, summary)) return false;
    CoulombPoint trial;
    double t = 2.0;
    do {  // halved until |F| decreases: the map has kinks, so its slope is unreliable
      t *= 0.5;
      trial = point_at(sub, point->w - t * d);
      ++summary->line_search_evaluations;
    } while (!(trial.F.norm() < (1.0 - kDecrease * t) * F.norm()) && t > kShortest);
    if (!(trial.F.norm() < F.norm())) return false;
    *point = std::move(trial);
  }
  return is_solved();
}

/// The solution with all contacts sticking, including those with a gap, if there is one. For rigid contacts
/// by a Cholesky factor, which then preconditions the proximal points.
std::optional<VecX> sticking_solution(const CoulombSubproblem& sub, bool rigid, CoulombDirection* direction,
                                      SolveSummary* summary) {
  const StickingSystem system = sticking_system(sub);
  VecX w;
  SolveSummary uncounted;
  const bool exists =
      rigid ? direction->solve_symmetric(sub.p, sub.graph, system.G, system.rhs, &w, summary)
            : direction->solve(sub.p, sub.graph, system.G, system.rhs, std::nullopt, &w, &uncounted);
  return exists ? std::optional(std::move(w)) : std::nullopt;
}

/// The ending of plain Newton, which is judged by the momentum residual `reached`.
void set_ending(bool solved, bool finite, double reached, const SolveOptions& options,
                SolveSummary* summary) {
  summary->reached = reached;
  summary->residual_history.push_back(reached);
  summary->ending = !finite                                          ? SolveEnding::failed
                    : solved                                         ? SolveEnding::converged
                    : summary->iterations >= *options.max_iterations ? SolveEnding::max_iterations
                                                                     : SolveEnding::stalled;
  summary->message =
      fmt::format("momentum residual {:.2e} {} tolerance {:.2e} after {}", reached, solved ? "<=" : ">",
                  options.tolerance, counted(summary->iterations, "iteration"));
}

/// The best solution so far, judged by residuals of the given problem.
struct BestSolution {
  const ContactProblem& problem;
  const WhitenedProblem& white;
  const ContactSolverOptions& options;
  ContactSolution* solution;
  double error = std::numeric_limits<double>::infinity();
  Residuals residuals{};

  void include(const VecX& w, const VecX& gamma, SolveSummary* summary) {
    const ContactSolution x{white.to_v(w), gamma};
    if (!x.v.allFinite() || !x.gamma.allFinite()) return;
    const Residuals now = compute_residuals(problem, x, options.reference_speed, options.law);
    summary->residual_history.push_back(largest_residual(now));
    const double excess_now = excess(now, options.tolerance);
    if (!(excess_now < error)) return;
    error = excess_now;
    residuals = now;
    *solution = x;
  }
};

}  // namespace

SolveSummary CoulombNewton::solve(const ContactProblem& problem, const ContactSolverOptions& options,
                                  ContactSolution* solution) {
  constexpr double kShare = 0.5;  // of the tolerance, so that residuals computed anew meet it too
  constexpr int kMaxOuterIterations = 200;
  constexpr double kInnerShare = 0.03;  // Rockafellar (1976), proximal point algorithm, criterion B
  constexpr double kFirstShare = 1.0, kLargestShare = 1e3, kSmallestShare = 1e-6;
  const double start = wall_seconds();
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(problem);
  CoulombSubproblem sub{white.problem,
                        graph,
                        options.law.dilatancy,
                        root_mean_mass(problem),
                        VecX::Zero(problem.num_contacts()),
                        VecX::Zero(problem.b.size())};
  CoulombDirection direction(&lu_);
  VecX diagonal;
  const auto set_share = [&](double share) {
    if (diagonal.size() == 0) diagonal = delassus_traces(problem) / 3.0;
    sub.R = share * diagonal;
  };
  const bool rigid = first_rigid_contact(problem).has_value();
  double share = rigid ? share_ : kFirstShare;
  const double scale = sub.root_mass * options.reference_speed;
  const double tolerance = kShare * options.tolerance * scale;
  BestSolution best{problem, white, options, solution};
  VecX w = white.problem.v_star;
  bool sticks = false;
  if (solution->v.size() == problem.v_star.size()) {
    w = white.to_w(solution->v);
  } else {
    factor_share_ = 0.0;
    if (rigid) set_share(share);
    if (std::optional<VecX> sticking = sticking_solution(sub, rigid, &direction, &summary)) {
      // Rigid blocks that can slide out of a structure would jam: they start from free fall.
      sticks = rigid && keeps_sticking(sub, point_at(sub, *sticking));
      if (sticks || !rigid) w = std::move(*sticking);
    }
  }

  // 1. Plain Newton
  if (!rigid) {
    factor_share_ = 0.0;
    CoulombPoint next = point_at(sub, w);
    const bool solved =
        solve_subproblem(sub, {.tolerance = tolerance, .inexact_directions = options.lag_factor}, options,
                         &direction, &next, &summary);
    if (solved || options.max_iterations) {
      const double reached = largest_block(next.F) / scale;
      *solution = {white.to_v(next.w), std::move(next.gamma)};
      const bool finite = std::isfinite(reached) && solution->v.allFinite() && solution->gamma.allFinite();
      set_ending(solved, finite, reached, options, &summary);
      summary.time_seconds = wall_seconds() - start;
      return summary;
    }
    best.include(next.w, next.gamma, &summary);
  }

  // 2. Proximal points
  if (solution->gamma.size() == problem.b.size()) sub.centre = solution->gamma;
  SubproblemAccuracy accuracy{.tolerance = 0.2 * tolerance, .share = sticks ? kInnerShare : 0.0};
  while (best.error > 1.0 && summary.outer_iterations < kMaxOuterIterations && share <= kLargestShare) {
    ++summary.outer_iterations;
    set_share(share);
    // R changes the matrix, which matters less where most contacts stick.
    accuracy.inexact_directions = sticks || (options.lag_factor && rigid && share == factor_share_);
    factor_share_ = sticks ? 0.0 : share;
    CoulombPoint next = point_at(sub, w);
    if (!solve_subproblem(sub, accuracy, options, &direction, &next, &summary)) {
      // What was right for the last problem is not for this one.
      share = summary.outer_iterations == 1 && share < kFirstShare ? kFirstShare : 10.0 * share;
      continue;
    }
    share_ = share;
    share = std::max(0.3 * share, kSmallestShare);
    w = std::move(next.w);
    sub.centre = std::move(next.gamma);
    best.include(w, sub.centre, &summary);
  }
  summary.time_seconds = wall_seconds() - start;
  if (!(best.error <= 1.0)) share_ = kFirstShare;
  if (!std::isfinite(best.error)) {
    summary.message = fmt::format("Newton found no usable point of the friction law in {}",
                                  counted(summary.iterations, "iteration"));
    return summary;
  }
  summary.ending = best.error <= 1.0 ? SolveEnding::converged : SolveEnding::stalled;
  summary.measure = ErrorMeasure::all_residuals;
  summary.reached = largest_residual(best.residuals);
  summary.message = fmt::format("{}, after {} for {}", residuals_text(best.residuals, options.tolerance),
                                counted(summary.iterations, "Newton iteration"),
                                counted(summary.outer_iterations, "proximal point"));
  return summary;
}

}  // namespace cupola
