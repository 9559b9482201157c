#include "solver/contact/methods/outer_iterations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "solver/contact/methods/anderson.hpp"
#include "solver/contact/problem/residuals.hpp"

namespace cupola {

namespace {

/// Proximal compliance R (3 nc), zero for contacts that need none. Where every contact has some compliance
/// and masses are similar, R is proportional to E: self-stress, which E alone determines, is then correct
/// from the first outer iteration on.
VecX proximal_compliance(const ContactProblem& p, double share) {
  constexpr double kLargestShare = 0.1;  // more would cost many outer iterations at heavy blocks
  VecX R = VecX::Zero(p.E.size());
  if (share == 0.0) return R;
  const VecX traces = delassus_traces(p);
  double ratio = 0.0, largest_ratio = std::numeric_limits<double>::infinity();
  for (int i = 0; i < p.num_contacts(); ++i) {
    const double N = traces[i] / 3.0;
    const auto E = p.E.segment<3>(3 * i).array();
    R.segment<3>(3 * i) = (share * N - E).cwiseMax(0.0);
    ratio = std::max(ratio, (R.segment<3>(3 * i).array() / E).maxCoeff());
    largest_ratio = std::min(largest_ratio, kLargestShare * N / E.maxCoeff());
  }
  return std::isfinite(ratio) && ratio <= largest_ratio ? VecX(ratio * p.E) : R;
}

/// b' - b = s n - R gamma at (v, gamma), with De Saxce's s = mu |y_t|, y = D^T v + b + E gamma (3 nc).
VecX shift_at(const ContactProblem& p, const ContactSolution& x, const VecX& R, const FlowRule& law) {
  VecX shift = -R.cwiseProduct(x.gamma);
  if (law.is_associated()) return shift;
  const VecX y = relative_velocity(p, x.v) + p.b + p.E.cwiseProduct(x.gamma);
  for (int i = 0; i < p.num_contacts(); ++i)
    shift[3 * i] += (1.0 - law.dilatancy) * p.mu[i] * y.segment<2>(3 * i + 1).norm();
  return shift;
}

/// State of the outer iteration.
class OuterIteration {
 public:
  OuterIteration(const ContactProblem& problem, const OuterOptions& options, const ContactSolution& guess)
      : problem_(problem),
        options_(options),
        convex_(problem),
        x_(guess),
        accelerated_(!options.law.is_associated() || smallest_compliance(problem) > 0.0),
        anderson_(kDepth) {
    if (x_.gamma.size() != problem.b.size()) x_.gamma = VecX::Zero(problem.b.size());
    if (x_.v.size() != problem.v_star.size()) x_.v = VecX(0);
    set_share(options.proximal_share);
  }
  void run(const ConvexSolve& solve, ContactSolution* best_solution, SolveSummary* summary);

 private:
  static constexpr int kDepth = 10;            // differences that Anderson acceleration combines
  static constexpr int kStagnationLimit = 80;  // outer iterations without a new best before `stalled`
  static constexpr int kRestartLimit = 16;     // outer iterations without a new best before Anderson restarts

  void set_share(double share);
  bool is_hopeless(int iteration, double best_residual) const;
  void adapt_share(const Residuals& residuals, double error, double last_error);

  const ContactProblem& problem_;
  const OuterOptions& options_;
  ContactProblem convex_;  ///< with E' and b'
  ContactSolution x_;
  const bool accelerated_;
  Anderson anderson_;
  double share_ = 0.0, smallest_share_ = 1e-9;
  VecX R_, shift_;
};

void OuterIteration::set_share(double share) {
  share_ = share;
  R_ = proximal_compliance(problem_, share);
  convex_.E = problem_.E + R_;
  shift_ = x_.v.size() > 0 ? shift_at(problem_, x_, R_, options_.law) : VecX(-R_.cwiseProduct(x_.gamma));
  anderson_.restart();
}

/// A smaller R contracts faster where impulses are poorly determined; a larger one loses fewer digits. No R
/// comes back that lost too many.
void OuterIteration::adapt_share(const Residuals& residuals, double error, double last_error) {
  constexpr double kLargest = 1e-2;
  constexpr double kSlow = 0.2;  // an outer iteration that gains less than this factor is not worth its cost
  if (share_ == 0.0) return;
  if (residuals.momentum > options_.tolerance && share_ < kLargest) {
    set_share(10.0 * share_);
    smallest_share_ = share_;
  } else if (residuals.momentum <= 0.1 * std::max(options_.tolerance, residuals.rigid_contact_speed) &&
             error > kSlow * last_error && share_ > smallest_share_) {
    set_share(0.1 * share_);
  }
}

/// Under Coulomb's law there may be no solution. Those that are found show early: of 314 problems of the
/// tests and of random walls and towers, none had a residual above 0.4 after 20 outer iterations.
bool OuterIteration::is_hopeless(int iteration, double best_residual) const {
  constexpr int kEarly = 20;
  constexpr double kLarge = 0.5;
  return !options_.law.is_associated() && iteration >= kEarly && best_residual > kLarge;
}

void OuterIteration::run(const ConvexSolve& solve, ContactSolution* best_solution, SolveSummary* summary) {
  SolveOptions inner = options_;
  const double coarse = 0.5 * options_.tolerance;
  inner.tolerance = coarse;
  double best = std::numeric_limits<double>::infinity(), last = best;
  Residuals best_residuals;
  int best_iteration = 0, iteration = 0;
  while (best > 1.0 && iteration < options_.max_outer_iterations &&
         iteration - best_iteration < kStagnationLimit &&
         !is_hopeless(iteration, largest_residual(best_residuals))) {
    // 1. Solve the convex problem
    summary->outer_iterations = ++iteration;
    convex_.b = problem_.b + shift_;
    const SolveSummary solved = solve(convex_, inner, &x_);
    summary->add_work(solved);
    if (!solved.usable()) {
      summary->message = fmt::format("outer iteration {}: {}", iteration, solved.message);
      break;
    }

    // A solve that keeps its guess shows nothing of the map, and differences of its errors mislead Anderson.
    // Where rounding forbids the smaller tolerance, the solve ends otherwise.
    if (solved.iterations == 0 && accelerated_)
      inner.tolerance = std::min(inner.tolerance, 0.1 * solved.reached);
    else if (solved.ending != SolveEnding::converged)
      inner.tolerance = coarse;

    // 2. Residuals on the given problem
    const Residuals residuals = compute_residuals(problem_, x_, options_.reference_speed, options_.law);
    summary->residual_history.push_back(largest_residual(residuals));
    const double error = excess(residuals, options_.tolerance);
    if (error < best) {
      best = error;
      best_iteration = iteration;
      best_residuals = residuals;
      *best_solution = x_;
    }

    // 3. Next shift. The proximal map of rigid contacts contracts by itself. De Saxce's map is accelerated,
    // and so is the proximal one where the compliance selects among impulses that balance the loads.
    const VecX next = shift_at(problem_, x_, R_, options_.law);
    if ((iteration - best_iteration) % kRestartLimit == kRestartLimit - 1) anderson_.restart();
    shift_ = accelerated_ ? anderson_.next(shift_, next) : next;
    adapt_share(residuals, error, last);
    last = error;
  }
  if (best_iteration == 0) return;  // the first convex solve failed
  summary->ending = best <= 1.0                                  ? SolveEnding::converged
                    : iteration >= options_.max_outer_iterations ? SolveEnding::max_iterations
                                                                 : SolveEnding::stalled;
  summary->measure = ErrorMeasure::all_residuals;
  summary->reached = largest_residual(best_residuals);
  summary->message = fmt::format("{}, after {}", residuals_text(best_residuals, options_.tolerance),
                                 counted(iteration, "outer iteration"));
}

}  // namespace

SolveSummary solve_by_outer_iterations(const ContactProblem& problem, const OuterOptions& options,
                                       const ConvexSolve& solve, ContactSolution* solution) {
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  OuterIteration(problem, options, *solution).run(solve, solution, &summary);
  CUPOLA_ASSERT(!summary.usable() || (solution->v.allFinite() && solution->gamma.allFinite()));
  return summary;
}

}  // namespace cupola
