#include "solver/analysis/direct_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/solve_conic.hpp"

namespace cupola {
namespace {

constexpr int kMaxTrials = 60;

/// The problem with one multiplier of a load.
ConicProblem with_multiplier(ConicProblem problem, const VecX& load, double cost) {
  problem.load_columns = load;
  problem.multiplier_cost = VecX::Constant(1, cost);
  problem.row_multipliers = MatX(1, 0);
  return problem;
}

DirectLimit not_found(std::string message) {
  DirectLimit limit;
  limit.message = std::move(message);
  return limit;
}

std::string at_both_ends(bool admissible, double low, double high) {
  return fmt::format("the structure {} at both ends of the bracket, {:g} and {:g}; widen the bracket",
                     admissible ? "stands" : "moves", low, high);
}

/// A solve of the pull alpha that the contacts need at one value.
struct PullSolve {
  double value = 0.0;
  double pull = 0.0;  ///< alpha; -infinity: as small as one likes
  bool decided = false;
  RigidScene scene;
  ConicProblem problem;
  ConicSolution solution;
};

PullSolve solve_pull(const SceneAt& scene_at, double value) {
  PullSolve solve;
  solve.value = value;
  solve.scene = scene_at(value);
  const ConicProblem& rigid = solve.scene.problem;
  VecX press = VecX::Zero(rigid.cost.size());
  press(Eigen::seq(0, Eigen::last, 3)).setConstant(solve.scene.model.block_weight);
  solve.problem = with_multiplier(rigid, -generalized_impulse(rigid.contacts, press), 1.0);
  solve.solution = solve_conic(solve.problem, {.target = 1e-10});
  // Imbalance that an admissible state may have, over the largest load of a block: rounding, or a small share
  // of what every contact has to spare.
  constexpr double kRounding = 1e-9, kShare = 1e-3;
  const double infinity = std::numeric_limits<double>::infinity();
  const ConicBounds bounds = conic_bounds(solve.problem, solve.solution);
  solve.pull = solve.solution.primal;
  switch (solve.solution.outcome) {
    case ConicOutcome::unbounded:
      solve.pull = -infinity;
      solve.decided = true;
      break;
    case ConicOutcome::infeasible:  // not even contacts that can pull hold it
      solve.pull = infinity;
      solve.decided = true;
      break;
    case ConicOutcome::optimal:
    case ConicOutcome::stalled:
      solve.decided = bounds.lower > 0.0 ||
                      (solve.pull <= 0.0 && bounds.imbalance <= std::max(kRounding, -kShare * solve.pull));
      break;
  }
  return solve;
}

/// df/dx at one value, from the friction there and at another value: mu is linear in x.
double slope_in_friction(const PullSolve& at, const PullSolve& other) {
  const ContactProblem& p = at.problem.contacts;
  const VecX s = relative_velocity(p, at.solution.v);
  double slope = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const double dmu = (other.problem.contacts.mu[i] - p.mu[i]) / (other.value - at.value);
    slope -= s.segment<2>(3 * i + 1).norm() * at.solution.gamma[3 * i] * dmu;
  }
  return slope;
}

/// The admissible state at the end of a search: of the pull problem if it has one, else any.
VecX admissible_state(const PullSolve& solve) {
  if (solve.solution.outcome != ConicOutcome::unbounded) {
    VecX gamma = solve.solution.gamma;
    gamma(Eigen::seq(0, Eigen::last, 3)).array() -=
        solve.solution.multipliers[0] * solve.scene.model.block_weight;
    return gamma;
  }
  return solve_conic(solve.scene.problem).gamma;
}

/// Two values on either side of the root.
class RootSearch {
 public:
  RootSearch(PullSolve low, PullSolve high, bool friction) : friction_(friction) {
    if (low.pull <= 0.0) std::swap(low, high);
    moving = std::move(low);
    admissible = std::move(high);
  }
  double width() const { return std::abs(admissible.value - moving.value); }
  double middle() const { return 0.5 * (admissible.value + moving.value); }
  /// The next value to try: just before the root of the linear model, and just behind it once the moving end
  /// is that close; the middle if there is no such root, or if the last one did not halve f.
  double next(double enough) const;
  void include(PullSolve solve);
  PullSolve moving, admissible;

 private:
  double root() const;  ///< of the linear model; NaN if there is none
  bool friction_;
  bool overshot_ = false;  ///< the last trial was admissible
  bool bisect_ = false;
};

void RootSearch::include(PullSolve solve) {
  const bool moves = solve.pull > 0.0;
  bisect_ = moves ? solve.pull > 0.5 * moving.pull : overshot_;
  overshot_ = !moves;
  (moves ? moving : admissible) = std::move(solve);
}

double RootSearch::root() const {
  if (!std::isfinite(moving.pull)) return std::numeric_limits<double>::quiet_NaN();
  if (friction_ && !overshot_) return moving.value - moving.pull / slope_in_friction(moving, admissible);
  const double slope = (admissible.pull - moving.pull) / (admissible.value - moving.value);
  return std::isfinite(slope) ? moving.value - moving.pull / slope : std::numeric_limits<double>::quiet_NaN();
}

double RootSearch::next(double enough) const {
  const double towards = admissible.value > moving.value ? 1.0 : -1.0;
  const double ahead = (root() - moving.value) * towards;
  if (bisect_ || !(ahead > 0.0 && ahead < width())) return middle();
  // At the root itself rounding decides. Half the width before it the structure moves; from there, half the
  // width behind it is the other end.
  const double aim = ahead > enough ? ahead - 0.45 * enough : ahead + 0.45 * enough;
  return moving.value + towards * std::min(aim, width() - 0.45 * enough);
}

}  // namespace

double DirectLimit::relative_width() const {
  const double size = std::abs(middle());
  return size > 0.0 ? std::abs(admissible - moving) / size : std::abs(admissible - moving);
}

DirectLimit limit_of_joints(const SceneAt& scene_at, double low, double high, double relative_width,
                            bool friction, const ReportTrial& report) {
  DirectLimit limit;
  const auto solve_at = [&](double value) {
    PullSolve solve = solve_pull(scene_at, value);
    ++limit.trials;
    limit.iterations += solve.solution.iterations;
    report({value, solve.decided && solve.pull <= 0.0, solve.pull, solve.solution.iterations});
    return solve;
  };
  PullSolve at_low = solve_at(low), at_high = solve_at(high);
  for (const PullSolve& end : {std::cref(at_low), std::cref(at_high)})
    if (!end.decided)
      return not_found(fmt::format(
          "the solve at {:g}, one end of the bracket, did not converge; move that end", end.value));
  if ((at_low.pull > 0.0) == (at_high.pull > 0.0))
    return not_found(at_both_ends(at_low.pull <= 0.0, low, high));
  RootSearch search(std::move(at_low), std::move(at_high), friction);
  while (limit.trials < kMaxTrials) {
    const double enough = relative_width * std::abs(search.middle());
    if (search.width() <= enough) break;
    const double value = search.next(enough);
    if (value == search.moving.value || value == search.admissible.value) break;
    PullSolve solve = solve_at(value);
    if (!solve.decided) {
      limit.message = fmt::format("; the solve at {:.8g} did not converge", value);
      break;
    }
    search.include(std::move(solve));
  }
  limit.found = true;
  limit.admissible = search.admissible.value;
  limit.moving = search.moving.value;
  limit.gamma = admissible_state(search.admissible);
  limit.mechanism = search.moving.solution.v;
  limit.at_admissible = std::move(search.admissible.scene);
  limit.at_moving = std::move(search.moving.scene);
  return limit;
}

namespace {

/// Admissible state at a value; `undecided` if the solve did not tell.
std::optional<bool> has_state(const SceneAt& scene_at, double value, DirectLimit* limit,
                              const ReportTrial& report) {
  const ConicSolution any = solve_conic(scene_at(value).problem);
  ++limit->trials;
  limit->iterations += any.iterations;
  const bool admissible = any.outcome == ConicOutcome::optimal;
  report({value, admissible, {}, any.iterations});
  if (any.outcome == ConicOutcome::stalled) return std::nullopt;
  return admissible;
}

/// w'(x) by central differences: exact for loads that are linear in x, to 1e-9 for a tilt in degrees.
VecX derivative_of_loads(const SceneAt& scene_at, double x) {
  constexpr double kStep = 1e-3;
  return (scene_at(x + kStep).problem.load - scene_at(x - kStep).problem.load) / (2.0 * kStep);
}

}  // namespace

DirectLimit limit_of_loads(const SceneAt& scene_at, double low, double high, double relative_width,
                           const ReportTrial& report) {
  constexpr int kMaxIterations = 30;
  DirectLimit limit;
  const std::optional<bool> at_low = has_state(scene_at, low, &limit, report);
  const std::optional<bool> at_high = has_state(scene_at, high, &limit, report);
  if (!at_low || !at_high)
    return not_found(fmt::format("the solve at {:g}, one end of the bracket, did not converge; move that end",
                                 at_low ? high : low));
  if (*at_low == *at_high) return not_found(at_both_ends(*at_low, low, high));
  const double towards = *at_low ? 1.0 : -1.0;
  double x = *at_low ? low : high;
  for (int k = 0; k < kMaxIterations; ++k) {
    limit.at_admissible = scene_at(x);
    const ConicProblem problem =
        with_multiplier(limit.at_admissible.problem, derivative_of_loads(scene_at, x), -towards);
    const ConicSolution solution = solve_conic(problem);
    const ConicBounds bounds = conic_bounds(problem, solution);
    ++limit.trials;
    limit.iterations += solution.iterations;
    if (solution.outcome == ConicOutcome::infeasible || solution.outcome == ConicOutcome::unbounded ||
        !std::isfinite(bounds.upper) || !std::isfinite(bounds.lower))
      return not_found(fmt::format("the linearised problem at {:.8g} is {}", x, to_string(solution.outcome)));
    const double step = solution.multipliers[0];
    limit.admissible = x - towards * bounds.upper;
    limit.moving = x - towards * std::min(bounds.lower, bounds.upper);
    limit.gamma = solution.gamma;
    limit.mechanism = solution.v;
    report({limit.admissible, true, {}, solution.iterations});
    const double next = std::clamp(x + step, low, high);
    // Done where the step is negligible, or exact because the loads are linear.
    const VecX missed = scene_at(x + step).problem.load - (problem.load + step * problem.load_columns);
    const bool exact = missed.norm() <= 1e-12 * problem.load.norm();
    x = next;
    if (exact || std::abs(step) <= 0.1 * relative_width * std::abs(x)) {
      limit.found = true;
      break;
    }
  }
  if (!limit.found) return not_found(fmt::format("no convergence after {} linearisations", kMaxIterations));
  limit.at_admissible = scene_at(limit.admissible);
  limit.at_moving = scene_at(limit.moving);
  return limit;
}

}  // namespace cupola
