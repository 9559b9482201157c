#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/analysis/admissible/pull_solve.hpp"
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
  double reach = 0.45 * relative_width * root;
  Ends ends{trials->solve(std::max(low, root - reach)), trials->solve(std::min(high, root + reach))};
  while (!ends.enclose() && trials->count < kMaxTrials) {
    reach *= 8.0;
    if (!ends.below.moves()) {
      if (ends.below.value <= low) break;
      if (ends.below.admissible()) ends.above = std::move(ends.below);
      ends.below = trials->solve(std::max(low, root - reach));
    } else {
      if (ends.above.value >= high) break;
      if (ends.above.moves()) ends.below = std::move(ends.above);
      ends.above = trials->solve(std::min(high, root + reach));
    }
  }
  return ends;
}

/// Two values on either side of the root, which the secant method and bisection close.
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
  void include(PullSolve solve);
  PullSolve moving, admissible;

 private:
  bool overshot_ = false;  ///< the last trial was admissible
  bool bisect_ = false;
};

void RootSearch::include(PullSolve solve) {
  const bool moves = solve.pull > 0.0;
  bisect_ = moves ? solve.pull > 0.5 * moving.pull : overshot_;
  overshot_ = !moves;
  (moves ? moving : admissible) = std::move(solve);
}

double RootSearch::next(double enough) const {
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
    if (search.width() <= enough) break;
    const double value = search.next(enough);
    if (value == search.moving.value || value == search.admissible.value) break;
    PullSolve solve = trials.solve(value);
    if (!solve.decided) {
      limit.message = fmt::format("; the solve at {:.8g} did not converge", value);
      break;
    }
    search.include(std::move(solve));
  }
  limit.found = true;
  limit.trials = trials.count;
  limit.iterations = trials.iterations;
  limit.admissible = search.admissible.value;
  limit.moving = search.moving.value;
  limit.gamma = admissible_state(search.admissible);
  limit.mechanism = search.moving.solution.v;
  limit.at_admissible = std::move(search.admissible.scene);
  limit.at_moving = std::move(search.moving.scene);
  const ConicProblem& moving = limit.at_moving.problem;
  limit.motion_proven = MotionProof(moving.contacts, moving.load).next_to(limit.mechanism).has_value();
  return limit;
}

}  // namespace cupola
