#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/motion_proof.hpp"
#include "solver/conic/opening_motion.hpp"
#include "solver/conic/solve_conic.hpp"

namespace cupola {
namespace {

/// Whether an admissible state exists at a value; none if the solve did not decide.
std::optional<bool> has_state(const SceneAt& scene_at, double value, DirectLimit* limit,
                              const ReportTrial& report) {
  const ConicSolution any = solve_conic(scene_at(value).problem);
  ++limit->trials;
  limit->iterations += any.iterations;
  std::optional<bool> admissible;
  if (any.outcome != ConicOutcome::stalled) admissible = any.outcome == ConicOutcome::optimal;
  report({value, admissible, {}, any.iterations});
  return admissible;
}

/// w'(x) by central differences: exact for loads that are linear in x, to 1e-9 for a tilt in degrees.
VecX derivative_of_loads(const SceneAt& scene_at, double x) {
  constexpr double kStep = 1e-3;
  return (scene_at(x + kStep).problem.load - scene_at(x - kStep).problem.load) / (2.0 * kStep);
}

/// The largest multiplier of the loads that grow with the parameter, towards higher (1) or lower (-1) values.
ConicProblem largest_multiplier(const SceneAt& scene_at, double x, double towards, RigidScene* scene) {
  *scene = scene_at(x);
  return with_multiplier(scene->problem, derivative_of_loads(scene_at, x), -towards);
}

/// True if the loads are linear in the parameter: the values at which it stands then form one interval.
bool are_linear(const SceneAt& scene_at, double low, double high) {
  const VecX at_low = scene_at(low).problem.load, change = scene_at(high).problem.load - at_low;
  const VecX missed = change - (high - low) * derivative_of_loads(scene_at, low);
  return missed.norm() <= 1e-9 * at_low.norm();  // of central differences
}

/// The structure stands at both ends of the bracket: perhaps it does at all values farther from zero.
DirectLimit stands_at_both_ends(const SceneAt& scene_at, double low, double high,
                                const std::function<double(double)>& in_unit, DirectLimit limit) {
  RigidScene scene;
  Sought why;
  if (derivative_of_loads(scene_at, high).isZero(0.0)) {
    scene = scene_at(high);
    why = {.reason = "the structure stands, and no load depends on the parameter",
           .advice = "give a load other than weight and fill, not 0 at the time 0"};
  } else {
    const double towards =
        std::abs(low) > std::abs(high) ? -1.0 : 1.0;  // where the loads of the parameter grow
    const double end = towards > 0.0 ? high : low;
    const ConicSolution grown = solve_conic(largest_multiplier(scene_at, end, towards, &scene));
    const bool linear = are_linear(scene_at, low, high);  // or what grows at this end says nothing of others
    why = at_both_ends(true, in_unit(low), in_unit(high));
    if (linear && grown.outcome == ConicOutcome::unbounded) {
      why = {.found = "no limit",
             .reason = fmt::format("the structure stands at {:g} and at every {} value, because the loads "
                                   "that grow with it have an admissible state by themselves",
                                   in_unit(towards > 0.0 ? low : high), towards > 0.0 ? "higher" : "lower")};
    } else if (linear) {
      why.found = fmt::format("no limit from {:g} to {:g}", in_unit(low), in_unit(high));
      if (grown.outcome == ConicOutcome::optimal)
        why.advice += fmt::format(" beyond about {:.4g}", in_unit(end + grown.multipliers[0]));
    }
  }
  limit = not_found(std::move(limit), std::move(why));
  limit.stands_at_both_ends = true;
  limit.gamma = solve_conic(scene.problem).gamma;
  limit.at_admissible = std::move(scene);
  return limit;
}

/// A limit of linear loads, without what rounding makes of zero.
double without_rounding(double value, double span) {
  return std::abs(value) <= kZeroLimit * span ? 0.0 : value;
}

/// The structure moves at both ends of the bracket. It stands in between or outside, if at all.
DirectLimit moves_at_both_ends(const SceneAt& scene_at, double low, double high,
                               const std::function<double(double)>& in_unit, DirectLimit limit) {
  limit = not_found(std::move(limit), at_both_ends(false, in_unit(low), in_unit(high)));
  limit.stands_at_both_ends = false;
  RigidScene scene;
  const ConicProblem from_low = largest_multiplier(scene_at, low, 1.0, &scene);
  if (are_linear(scene_at, low, high)) {
    const ConicSolution greatest = solve_conic(from_low);
    const bool bounded = greatest.outcome == ConicOutcome::optimal;
    const double end = bounded ? without_rounding(low + greatest.multipliers[0], high - low)
                               : std::numeric_limits<double>::infinity();
    const std::string everywhere =
        fmt::format("the structure moves at every value from {:g} to {:g}", in_unit(low), in_unit(high));
    if (greatest.outcome == ConicOutcome::infeasible) {
      limit.sought = {.reason = everywhere +
                                ", because no multiple of the loads that grow with it holds the others"};
    } else if (bounded && end > low && end < high) {
      const ConicSolution least = solve_conic(largest_multiplier(scene_at, high, -1.0, &scene));
      const std::string from =
          least.outcome == ConicOutcome::optimal
              ? fmt::format(" from {:g}", in_unit(without_rounding(high + least.multipliers[0], high - low)))
              : "";
      limit.sought.also = fmt::format("it stands{} up to {:g}", from, in_unit(end));
      limit.stands_at_both_ends.reset();  // it does not move throughout
    } else if (bounded || greatest.outcome == ConicOutcome::unbounded) {
      limit.sought = {.reason = everywhere,
                      .also = end < high ? fmt::format("it stands only below, up to {:g}", in_unit(end))
                                         : "it stands only above"};
    }
  }
  limit.at_moving = scene_at(low);
  limit.mechanism = solve_conic(limit.at_moving.problem).v;
  return limit;
}

/// "it moves again beyond 1.2418": of linear loads of which the structure needs some, the limit on the other
/// side of the interval in which it stands; "" if there is none. `moves` and `stands`: the bracket of the
/// limit sought.
std::string other_limit(const SceneAt& scene_at, double moves, double stands) {
  if (!are_linear(scene_at, moves, stands)) return "";
  RigidScene scene;
  const bool beyond = stands > moves;
  const ConicSolution grown = solve_conic(largest_multiplier(scene_at, stands, beyond ? 1.0 : -1.0, &scene));
  if (grown.outcome != ConicOutcome::optimal) return "";
  const double value = without_rounding(stands + grown.multipliers[0], std::abs(stands - moves));
  return fmt::format("it moves again {} {:.5g}", beyond ? "beyond" : "below", value);
}

/// Moves one end of a bracket to its middle, and returns it; none if the solve there did not decide.
std::optional<double> halve(const SceneAt& scene_at, double* stands, double* moves, DirectLimit* limit,
                            const ReportTrial& report) {
  const double middle = 0.5 * (*stands + *moves);
  const std::optional<bool> at_middle = has_state(scene_at, middle, limit, report);
  if (!at_middle) return std::nullopt;
  (*at_middle ? *stands : *moves) = middle;
  return middle;
}

/// Whether bounds lie within the bracket of a search, to the width required or, at zero, to rounding.
bool is_within(double stands, double moves, double relative_width, const DirectLimit& bounds) {
  const auto [low, high] = std::minmax(stands, moves);
  const auto slack = [&](double end) {
    return std::max(relative_width * std::abs(end), kZeroLimit * bounds.span);
  };
  const auto [least, most] = std::minmax(bounds.admissible, bounds.moving);
  return least >= low - slack(low) && most <= high + slack(high);
}

/// A bracket that is narrow enough is the limit.
void take_bracket(const SceneAt& scene_at, double stands, double moves, double relative_width,
                  DirectLimit* limit) {
  limit->admissible = stands;
  limit->moving = moves;
  limit->found = limit->relative_width() <= relative_width;
  if (!limit->found) return;
  limit->gamma = solve_conic(scene_at(stands).problem).gamma;
  limit->mechanism = solve_conic(scene_at(moves).problem).v;
}

/// Adds the scenes at the two bounds, and whether the mechanism proves the motion.
void complete(const SceneAt& scene_at, double towards, DirectLimit* limit) {
  // At the bound itself the loads do no work on the mechanism.
  constexpr double kBeyond = 1e-9;
  for (double* end : {&limit->admissible, &limit->moving})
    if (std::abs(*end) <= 1e-12 * limit->span) *end = 0.0;  // rounding
  const double scale = std::max(std::abs(limit->moving), std::abs(limit->admissible));
  const double proven = limit->moving + towards * kBeyond * (limit->is_zero() ? limit->span : scale);
  if (limit->moving == limit->admissible) limit->moving = proven;  // which end moves must show
  limit->at_admissible = scene_at(limit->admissible);
  limit->at_moving = scene_at(limit->moving);
  const RigidScene beyond = scene_at(proven);
  limit->motion_proven =
      MotionProof(beyond.problem.contacts, beyond.problem.load).next_to(limit->mechanism).has_value();
}

}  // namespace

DirectLimit limit_of_loads(const SceneAt& scene_at, double low, double high, double relative_width,
                           const ReportTrial& report, const std::function<double(double)>& in_unit,
                           std::optional<double> own) {
  constexpr int kMaxIterations = 30;
  DirectLimit limit;
  std::optional<bool> at_low = has_state(scene_at, low, &limit, report);
  const std::optional<bool> at_high = has_state(scene_at, high, &limit, report);
  std::string other;
  if (own && at_low == false && at_high == false && has_state(scene_at, *own, &limit, report) == true) {
    other = other_limit(scene_at, high, *own);
    low = *own;
    at_low = true;
  } else if (own && at_low == false && at_high == true) {
    other = other_limit(scene_at, low, high);
  }
  if (!at_low || !at_high) return not_found(std::move(limit), unsolved_end(in_unit(at_low ? high : low)));
  if (*at_low && *at_high) return stands_at_both_ends(scene_at, low, high, in_unit, std::move(limit));
  if (!*at_low && !*at_high) return moves_at_both_ends(scene_at, low, high, in_unit, std::move(limit));
  const double towards = *at_low ? 1.0 : -1.0;
  double stands = *at_low ? low : high, moves = *at_low ? high : low;
  limit.span = high - low;
  const double enough = 0.1 * relative_width;
  double x = stands;
  for (int k = 0; k < kMaxIterations && !limit.found; ++k) {
    const ConicProblem problem = largest_multiplier(scene_at, x, towards, &limit.at_admissible);
    ConicSolution solution = solve_conic(problem);
    ++limit.trials;
    limit.iterations += solution.iterations;
    const double step = solution.multipliers[0];
    const ConicBounds bounds = multiplier_bounds(problem, enough * std::abs(x + step), &solution);
    limit.admissible = x - towards * bounds.upper;
    limit.moving = x - towards * bounds.lower;
    // Done where the step is negligible, or exact because the loads are linear.
    const VecX missed = scene_at(x + step).problem.load - (problem.load + step * problem.load_columns);
    const bool exact = missed.norm() <= 1e-12 * problem.load.norm();
    const double next = std::clamp(x + step, std::min(stands, moves), std::max(stands, moves));
    const bool done = exact || std::abs(step) <= enough * std::abs(next);
    // The loads that the state lacks count as what the mechanism makes of them, which may be anything.
    const double lacking = std::abs(limit.admissible - (x + step));
    const double size = limit.is_zero() ? limit.span : std::abs(x + step);
    const bool usable = solution.outcome != ConicOutcome::infeasible &&
                        solution.outcome != ConicOutcome::unbounded && std::isfinite(bounds.lower) &&
                        lacking <= enough * size;
    if (!usable || (done && !is_within(stands, moves, relative_width, limit))) {
      // Loads that are not linear may have a limit where they are no longer like those here. And where
      // rounding alone keeps forces from balance, a solve ends at any value.
      const std::optional<double> middle = halve(scene_at, &stands, &moves, &limit, report);
      if (!middle)
        return not_found(std::move(limit), {.reason = fmt::format("the linearised problem at {:.8g} is {}",
                                                                  in_unit(x), to_string(solution.outcome))});
      x = *middle;
      take_bracket(scene_at, stands, moves, relative_width, &limit);
      continue;
    }
    limit.gamma = solution.gamma;
    limit.mechanism = solution.v;
    report({limit.admissible, true, {}, solution.iterations});
    x = next;
    limit.found = done;
  }
  if (!limit.found)
    return not_found(std::move(limit),
                     {.reason = fmt::format("no convergence after {} linearisations", kMaxIterations)});
  limit.sought.also = std::move(other);
  complete(scene_at, towards, &limit);
  return limit;
}

}  // namespace cupola
