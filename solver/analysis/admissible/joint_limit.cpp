#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/analysis/admissible/pull_solve.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/motion_proof.hpp"

namespace cupola {
namespace {

constexpr int kMaxTrials = 60;
/// Least friction of a search: below it rounding of the geometry decides whether level beds slide.
constexpr double kNoFriction = 1e-8;

/// Solves at values of the parameter, counts and reports them.
class PullTrials {
 public:
  PullTrials(const SceneAt& scene_at, const ReportTrial& report) : scene_at_(scene_at), report_(report) {}
  PullSolve solve(double value, bool estimate = false) {
    PullSolve solve = solve_pull(value, scene_at_(value), estimate);
    ++count;
    iterations += solve.solution.iterations;
    report_({value, solve.pull <= 0.0, solve.pull, solve.solution.iterations});
    return solve;
  }
  VecX friction_at(double value) const { return scene_at_(value).problem.contacts.mu; }
  int count = 0, iterations = 0;

 private:
  const SceneAt& scene_at_;
  const ReportTrial& report_;
};

/// Solves on either side of a root: below it the structure moves.
struct Ends {
  PullSolve below, above;
  bool enclose() const { return below.moves() && above.admissible(); }
};

/// The critical friction between two values, by Newton's method on rough solves.
double estimate_root(double low, double high, double relative_width, const VecX& dmu_dx, PullTrials* trials) {
  constexpr int kMostEstimates = 15;
  // Near the root a step of relative size e leaves an error of about e^2 / 2.
  const double last_step = std::sqrt(0.2 * relative_width);
  double moves = low, stands = high;  // assumed of the ends
  bool low_solved = false, high_solved = false;
  double x = low > kNoFriction ? std::sqrt(low * high) : 0.5 * (low + high);
  for (int k = 0; k < kMostEstimates; ++k) {
    const PullSolve at = trials->solve(x, true);
    (at.pull > 0.0 ? moves : stands) = x;
    double root = x - at.pull / slope_in_friction(at, dmu_dx);
    if (const bool lowest = root <= low, highest = root >= high;
        (lowest && !low_solved) || (highest && !high_solved)) {
      (lowest ? low_solved : high_solved) = true;  // perhaps the ends do not enclose the root
      x = lowest ? low : high;
      continue;
    }
    if (stands <= low || moves >= high) return x;
    if (!(root > moves && root < stands))
      root = 0.5 * (moves + stands);
    else if (std::abs(root - x) <= last_step * root)
      return root;
    if (stands - moves <= relative_width * stands) return root;
    x = root;
  }
  return x;
}

/// Solves just below and just above the estimated root, farther away if both are on one side or one does not decide.
Ends ends_around(double root, double low, double high, double relative_width, PullTrials* trials) {
  constexpr double kFarther = 8.0;
  double down = 0.45 * relative_width * root, up = down;
  Ends ends{trials->solve(std::max(low, root - down)), trials->solve(std::min(high, root + up))};
  while (!ends.enclose() && trials->count < kMaxTrials) {
    if (!ends.below.moves()) {
      if (ends.below.value <= low) break;
      down *= kFarther;
      if (ends.below.admissible()) ends.above = std::move(ends.below);
      ends.below = trials->solve(std::max(low, root - down));
    } else {
      if (ends.above.value >= high) break;
      up *= kFarther;
      if (ends.above.moves()) ends.below = std::move(ends.above);
      ends.above = trials->solve(std::min(high, root + up));
    }
  }
  return ends;
}

/// Two values on either side of the root, which the secant method and bisection close. Values between them that do not decide are left
/// out: the search then closes in on them from both sides.
class RootSearch {
 public:
  explicit RootSearch(Ends ends) {
    if (ends.below.pull <= 0.0) std::swap(ends.below, ends.above);
    moving = std::move(ends.below);
    admissible = std::move(ends.above);
  }
  double width() const { return std::abs(admissible.value - moving.value); }
  double middle() const { return 0.5 * (admissible.value + moving.value); }
  /// The next value to try: just before the root of the linear model, and just behind it once the moving end
  /// is that close; the middle if there is no such root, or if the last one did not halve f.
  double next(double enough) const;
  bool is_closed(double enough) const;
  void include(PullSolve solve);
  void leave_out(double value);
  /// The least and the greatest value that did not decide.
  const std::optional<std::pair<double, double>>& undecided() const { return undecided_; }
  PullSolve moving, admissible;

 private:
  /// Distance from the moving and from the admissible end to the nearest value that did not decide.
  std::pair<double, double> open_gaps() const;

  bool overshot_ = false;  ///< the last trial was admissible
  bool bisect_ = false;
  std::optional<std::pair<double, double>> undecided_;
};

std::pair<double, double> RootSearch::open_gaps() const {
  const auto& [least, greatest] = *undecided_;
  const bool moves_below = moving.value < admissible.value;
  return {std::abs((moves_below ? least : greatest) - moving.value),
          std::abs((moves_below ? greatest : least) - admissible.value)};
}

bool RootSearch::is_closed(double enough) const {
  if (width() <= enough) return true;
  if (!undecided_) return false;
  // Closing in further would gain less than half of what stays undecided.
  const auto [from_moving, from_admissible] = open_gaps();
  return std::max(from_moving, from_admissible) <=
         std::max(enough, 0.5 * (undecided_->second - undecided_->first));
}

void RootSearch::leave_out(double value) {
  if (!undecided_) undecided_ = {value, value};
  undecided_ = {std::min(undecided_->first, value), std::max(undecided_->second, value)};
}

void RootSearch::include(PullSolve solve) {
  const bool moves = solve.pull > 0.0;
  bisect_ = moves ? solve.pull > 0.5 * moving.pull : overshot_;
  overshot_ = !moves;
  (moves ? moving : admissible) = std::move(solve);
}

double RootSearch::next(double enough) const {
  if (undecided_) {
    const auto [from_moving, from_admissible] = open_gaps();
    const double outward = admissible.value > moving.value ? 0.5 : -0.5;
    return from_moving >= from_admissible ? moving.value + outward * from_moving
                                          : admissible.value - outward * from_admissible;
  }
  const double towards = admissible.value > moving.value ? 1.0 : -1.0;
  const double slope = (admissible.pull - moving.pull) / (admissible.value - moving.value);
  const double ahead = -moving.pull / slope * towards;
  if (bisect_ || !std::isfinite(slope) || !(ahead > 0.0 && ahead < width())) return middle();
  // At the root itself rounding decides. Half the width before it the structure moves; from there, half the
  // width behind it is the other end.
  const double aim = ahead > enough ? ahead - 0.45 * enough : ahead + 0.45 * enough;
  return moving.value + towards * std::min(aim, width() - 0.45 * enough);
}

Ends first_ends(double low, double high, double relative_width, bool friction, PullTrials* trials) {
  if (!friction) return {trials->solve(low), trials->solve(high)};
  const VecX dmu_dx = (trials->friction_at(high) - trials->friction_at(low)) / (high - low);
  return ends_around(estimate_root(low, high, relative_width, dmu_dx, trials), low, high, relative_width,
                     trials);
}

}  // namespace

DirectLimit limit_of_joints(const SceneAt& scene_at, double low, double high, double relative_width,
                            bool friction, const ReportTrial& report) {
  PullTrials trials(scene_at, report);
  if (friction) low = std::max(low, kNoFriction);
  Ends ends = first_ends(low, high, relative_width, friction, &trials);
  for (const PullSolve& end : {std::cref(ends.below), std::cref(ends.above)})
    if (!end.decided)
      return not_found(fmt::format(
          "the solve at {:g}, one end of the bracket, did not converge; move that end", end.value));
  if (ends.below.admissible() == ends.above.admissible()) {
    DirectLimit limit = not_found(at_both_ends(ends.below.admissible(), low, high));
    if (friction && low == kNoFriction && ends.below.admissible()) {
      limit.unlimited = true;
      limit.message =
          fmt::format("no limit: the structure stands without friction (below {:g})", kNoFriction);
    }
    limit.trials = trials.count;
    limit.iterations = trials.iterations;
    if (ends.below.admissible()) {
      limit.gamma = admissible_state(ends.below);
      limit.at_admissible = std::move(ends.below.scene);
    } else {
      limit.mechanism = ends.below.solution.v;
      limit.at_moving = std::move(ends.below.scene);
    }
    return limit;
  }
  DirectLimit limit;
  RootSearch search(std::move(ends));
  while (trials.count < kMaxTrials) {
    const double enough = relative_width * std::abs(search.middle());
    if (search.is_closed(enough)) break;
    const double value = search.next(enough);
    if (value == search.moving.value || value == search.admissible.value) break;
    PullSolve solve = trials.solve(value);
    if (solve.decided)
      search.include(std::move(solve));
    else
      search.leave_out(value);
  }
  if (const auto& undecided = search.undecided())
    limit.message = undecided->first == undecided->second
                        ? fmt::format("; the solve at {:.8g} did not decide", undecided->first)
                        : fmt::format("; the solves from {:.8g} to {:.8g} did not decide", undecided->first,
                                      undecided->second);
  limit.found = true;
  limit.trials = trials.count;
  limit.iterations = trials.iterations;
  limit.admissible = search.admissible.value;
  limit.moving = search.moving.value;
  limit.gamma = admissible_state(search.admissible);
  limit.mechanism = search.moving.solution.v;
  limit.at_admissible = std::move(search.admissible.scene);
  limit.at_moving = std::move(search.moving.scene);
  if (std::isfinite(search.moving.pull))
    limit.resisting_forces = positive_up_to(search.moving.problem, search.moving.solution);
  const ConicProblem& moving = limit.at_moving.problem;
  limit.motion_proven = MotionProof(moving.contacts, moving.load).next_to(limit.mechanism).has_value();
  return limit;
}

}  // namespace cupola
