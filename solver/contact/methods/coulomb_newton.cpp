#include "solver/contact/methods/coulomb_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "solver/contact/methods/coulomb_direction.hpp"
#include "solver/contact/methods/coulomb_subproblem.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

namespace {

/// The solution with all contacts sticking, including those with a gap, if there is one. For rigid contacts
/// by a Cholesky factor, which then preconditions the proximal points.
std::optional<VecX> sticking_solution(const CoulombSubproblem& sub, bool rigid, CoulombDirection* direction,
                                      SolveSummary* summary) {
  const StickingSystem system = sticking_system(sub);
  VecX w;
  SolveSummary uncounted;
  const bool exists = rigid ? direction->solve_symmetric(system.G, system.rhs, &w, summary)
                            : direction->solve(system.G, system.rhs, {}, &w, &uncounted);
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

/// What the solver object keeps between solves.
struct Kept {
  BlockLu* lu;
  double *share, *factor_share;
};

constexpr double kFirstShare = 1.0;  // of the Delassus blocks

/// One solve; `solution`: the guess, if it has the size.
class CoulombSolve {
 public:
  CoulombSolve(const ContactProblem& problem, const ContactSolverOptions& options, const Kept& kept,
               ContactSolution* solution)
      : problem_(problem), options_(options), kept_(kept), solution_(solution) {}

  SolveSummary run() {
    choose_start();
    if (rigid_ || !solve_by_newton()) {
      solve_by_proximal_points();
      conclude();
    }
    return summary_;
  }

 private:
  void choose_start();
  bool solve_by_newton();
  void solve_by_proximal_points();
  void conclude();

  void set_share(double share) {
    if (diagonal_.size() == 0) diagonal_ = delassus_traces(problem_) / 3.0;
    sub_.R = share * diagonal_;
  }

  static constexpr double kMargin = 0.5;  // of the tolerance, so that residuals computed anew meet it too

  const ContactProblem& problem_;
  const ContactSolverOptions& options_;
  const Kept kept_;
  ContactSolution* const solution_;
  SolveSummary summary_;
  const WhitenedProblem white_ = whiten(problem_);
  const ContactGraph graph_ = contact_graph(problem_);
  CoulombSubproblem sub_{white_, options_.law.dilatancy, root_mean_mass(problem_),
                         VecX::Zero(problem_.num_contacts()), VecX::Zero(problem_.b.size())};
  // A guess without impulses is that of a single solve, for which an LU factor would not be kept.
  CoulombDirection direction_{white_, graph_, kept_.lu,
                              solution_->gamma.size() == 0 ? CoulombDirection::First::symmetric
                                                           : CoulombDirection::First::unsymmetric};
  BestSolution best_{problem_, white_, options_, solution_};
  const bool rigid_ = first_rigid_contact(problem_).has_value();
  const double scale_ = sub_.root_mass * options_.reference_speed;
  const double tolerance_ = kMargin * options_.tolerance * scale_;  // of each block of F
  bool sticks_ = false;
  VecX w_ = white_.w_star;
  VecX diagonal_;  // of the Delassus blocks, 1/kg (nc)
};

void CoulombSolve::choose_start() {
  if (solution_->v.size() == problem_.v_star.size()) {
    w_ = white_.to_w(solution_->v);
    return;
  }
  *kept_.factor_share = 0.0;
  if (rigid_) set_share(*kept_.share);
  std::optional<VecX> sticking = sticking_solution(sub_, rigid_, &direction_, &summary_);
  if (!sticking) return;
  // Rigid blocks that can slide out of a structure would jam: they start from free fall.
  sticks_ = rigid_ && keeps_sticking(sub_, point_at(sub_, *sticking));
  if (sticks_ || !rigid_) w_ = std::move(*sticking);
}

/// Plain Newton, of compliant contacts. False if it failed and the proximal points are to be tried.
bool CoulombSolve::solve_by_newton() {
  *kept_.factor_share = 0.0;
  CoulombPoint next = point_at(sub_, w_);
  const bool solved =
      solve_subproblem(sub_, {.tolerance = tolerance_, .inexact_directions = options_.lag_factor}, options_,
                       &direction_, &next, &summary_);
  if (!solved && !options_.max_iterations) {
    best_.include(next.w, next.gamma, &summary_);
    return false;
  }
  const double reached = largest_block_norm(next.F) / scale_;
  *solution_ = {white_.to_v(next.w), std::move(next.gamma)};
  const bool finite = std::isfinite(reached) && solution_->v.allFinite() && solution_->gamma.allFinite();
  set_ending(solved, finite, reached, options_, &summary_);
  return true;
}

void CoulombSolve::solve_by_proximal_points() {
  constexpr int kMaxOuterIterations = 200;
  constexpr double kInnerShare = 0.03;  // Rockafellar (1976), proximal point algorithm, criterion B
  constexpr double kLargestShare = 1e3, kSmallestShare = 1e-6;
  if (solution_->gamma.size() == problem_.b.size()) sub_.centre = solution_->gamma;
  SubproblemAccuracy accuracy{.tolerance = 0.2 * tolerance_, .share = sticks_ ? kInnerShare : 0.0};
  double share = rigid_ ? *kept_.share : kFirstShare;
  while (best_.error > 1.0 && summary_.outer_iterations < kMaxOuterIterations && share <= kLargestShare) {
    ++summary_.outer_iterations;
    set_share(share);
    // R changes the matrix, which matters less where most contacts stick.
    accuracy.inexact_directions = sticks_ || (options_.lag_factor && rigid_ && share == *kept_.factor_share);
    *kept_.factor_share = sticks_ ? 0.0 : share;
    CoulombPoint next = point_at(sub_, w_);
    if (!solve_subproblem(sub_, accuracy, options_, &direction_, &next, &summary_)) {
      // What was right for the last problem is not for this one.
      share = summary_.outer_iterations == 1 && share < kFirstShare ? kFirstShare : 10.0 * share;
      continue;
    }
    *kept_.share = share;
    share = std::max(0.3 * share, kSmallestShare);
    w_ = std::move(next.w);
    sub_.centre = std::move(next.gamma);
    best_.include(w_, sub_.centre, &summary_);
  }
  if (!(best_.error <= 1.0)) *kept_.share = kFirstShare;
}

/// The ending of the proximal points.
void CoulombSolve::conclude() {
  if (!std::isfinite(best_.error)) {
    summary_.message = fmt::format("Newton found no usable point of the friction law in {}",
                                   counted(summary_.iterations, "iteration"));
    return;
  }
  summary_.ending = best_.error <= 1.0 ? SolveEnding::converged : SolveEnding::stalled;
  summary_.measure = ErrorMeasure::all_residuals;
  summary_.reached = largest_residual(best_.residuals);
  summary_.message = fmt::format("{}, after {} for {}", residuals_text(best_.residuals, options_.tolerance),
                                 counted(summary_.iterations, "Newton iteration"),
                                 counted(summary_.outer_iterations, "proximal point"));
}

}  // namespace

SolveSummary CoulombNewton::solve(const ContactProblem& problem, const ContactSolverOptions& options,
                                  ContactSolution* solution) {
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  return CoulombSolve(problem, options, {&lu_, &share_, &factor_share_}, solution).run();
}

}  // namespace cupola
