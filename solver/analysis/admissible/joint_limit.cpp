#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/analysis/admissible/pull_search.hpp"
#include "solver/analysis/admissible/pull_solve.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/motion_proof.hpp"

namespace cupola {
namespace {

constexpr int kMaxTrials = 60;
/// Least friction of a search: below it rounding of the geometry decides whether level beds slide.
constexpr double kNoFriction = 1e-5;
/// The same of joints with cohesion c, whose cones begin at a pull of c over the friction: beyond these, few
/// solves converge.
constexpr double kLeastOfMortar = 1e-3;
constexpr int kMostRaised = 3;  // times that it is doubled

/// Solves at values of the parameter, counts and reports them.
class PullTrials {
 public:
  PullTrials(const SceneAt& scene_at, const ReportTrial& report) : scene_at_(scene_at), report_(report) {}
  PullSolve solve(double value, double estimate = 0.0) {
    PullSolve solve = solve_pull(value, scene_at_(value), estimate);
    ++count;
    iterations += solve.solution.iterations;
    report_({value, solve.decided ? std::optional(solve.admissible()) : std::nullopt, solve.pull,
             solve.solution.iterations});
    return solve;
  }
  DirectLimit counts() const {
    DirectLimit limit;
    limit.trials = count;
    limit.iterations = iterations;
    return limit;
  }
  RigidScene scene_at(double value) const { return scene_at_(value); }
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

/// The critical value between two, by Newton's method on rough solves.
/// `rough`: share of the pull to which it is found.
double estimate_root(double low, double high, double relative_width, const JointsDerivative& joints,
                     double rough, PullTrials* trials) {
  constexpr int kMostEstimates = 15;
  // Near the root a step of relative size e leaves an error of about e^2 / 2.
  const double last_step = std::sqrt(0.2 * relative_width);
  double moves = low, stands = high;  // assumed of the ends
  bool low_solved = false, high_solved = false;
  double x = low > kNoFriction ? std::sqrt(low * high) : 0.5 * (low + high);
  for (int k = 0; k < kMostEstimates; ++k) {
    const PullSolve at = trials->solve(x, rough);
    (at.pull > 0.0 ? moves : stands) = x;
    double root = x - at.pull / joints.slope(at);
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

/// Solves just below and just above the estimated root, farther away if both are on one side or one does not
/// decide.
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

Ends first_ends(double low, double high, double relative_width, LimitSearch::Parameter parameter,
                PullTrials* trials) {
  const RigidScene at_low = trials->scene_at(low), at_high = trials->scene_at(high);
  if (parameter == LimitSearch::Parameter::thickness || at_low.open_in_part || at_high.open_in_part)
    return {trials->solve(low), trials->solve(high)};
  // Small joints have small arms, which magnify the error of a force in alpha.
  const double rough = parameter == LimitSearch::Parameter::friction ? 1e-2 : 1e-4;
  const JointsDerivative joints(low, at_low.problem.contacts, high, at_high.problem.contacts);
  return ends_around(estimate_root(low, high, relative_width, joints, rough, trials), low, high,
                     relative_width, trials);
}

/// Tension ends at cohesion over friction, and the shear beside it falls with friction.
bool bears_tension(const ContactProblem& joints) {
  return std::ranges::any_of(joints.strength, [](const ContactStrength& s) { return s.tension > 0.0; });
}

/// The structure stands, or moves, at both ends. `more_bears_more`: what the joints bear grows with the
/// parameter.
DirectLimit without_limit(Ends ends, double low, double high, LimitSearch::Parameter parameter,
                          bool more_bears_more, const DirectLimit& counts) {
  DirectLimit limit = not_found(counts, at_both_ends(ends.below.admissible(), low, high));
  limit.stands_at_both_ends = ends.below.admissible();
  const bool needs_none =
      parameter == LimitSearch::Parameter::friction && low == kNoFriction && ends.below.admissible();
  if (needs_none)
    limit.sought = {
        .found = "no limit",
        .reason = fmt::format("the structure stands with a friction of {:g}, as good as none", kNoFriction)};
  // Joints with less friction or of less extent bear no force that the others do not.
  const bool end_solved = ends.below.admissible() ? ends.below.value <= low : ends.above.value >= high;
  if (parameter != LimitSearch::Parameter::thickness && more_bears_more && !needs_none && end_solved)
    limit.sought = {.found = ends.below.admissible() ? fmt::format("no limit above {:g}", low) : "",
                    .reason = fmt::format("the structure {} at every value from {:g} to {:g}",
                                          ends.below.admissible() ? "stands" : "moves", low, high)};
  if (ends.below.admissible()) {
    limit.gamma = admissible_state(ends.below);
    limit.at_admissible = std::move(ends.below.scene);
  } else {
    limit.mechanism = ends.below.solution.v;
    limit.at_moving = std::move(ends.below.scene);
  }
  return limit;
}

}  // namespace

DirectLimit limit_of_joints(const SceneAt& scene_at, double low, double high, double relative_width,
                            LimitSearch::Parameter parameter, const ReportTrial& report) {
  const bool friction = parameter == LimitSearch::Parameter::friction;
  PullTrials trials(scene_at, report);
  double floor = -std::numeric_limits<double>::infinity();
  if (friction) {
    const bool dry = trials.scene_at(high).problem.contacts.strength.empty();
    const double least = dry ? kNoFriction : kLeastOfMortar;
    if (high <= least)
      throw InputError(
          fmt::format("analysis.limit.high = {}: must exceed {}, the least friction of a search{}", high,
                      least, dry ? "" : " with cohesion"));
    floor = least;
    low = std::max(low, least);
  }
  Ends ends = first_ends(low, high, relative_width, parameter, &trials);
  // Rounding, which differs between machines, decides whether a solve at the floor converges.
  const auto decided = [&ends] { return ends.below.decided && ends.above.decided; };
  for (int raised = 0; raised < kMostRaised && low == floor && !decided(); ++raised) {
    low = floor *= 2.0;
    ends = first_ends(low, high, relative_width, parameter, &trials);
  }
  const bool more_bears_more = !friction || !bears_tension(trials.scene_at(high).problem.contacts);
  if (!more_bears_more && ends.below.admissible() == ends.above.admissible())
    ends = {trials.solve(low), trials.solve(high)};
  for (const PullSolve& end : {std::cref(ends.below), std::cref(ends.above)})
    if (!end.decided) return not_found(trials.counts(), unsolved_end(end.value));
  if (ends.below.admissible() == ends.above.admissible())
    return without_limit(std::move(ends), low, high, parameter, more_bears_more, trials.counts());
  PullSearch search(std::move(ends.below), std::move(ends.above));
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
  DirectLimit limit = trials.counts();
  if (const auto& undecided = search.undecided())
    limit.sought.reason = undecided->first == undecided->second
                              ? fmt::format("the solve at {:.8g} did not decide", undecided->first)
                              : fmt::format("the solves from {:.8g} to {:.8g} did not decide",
                                            undecided->first, undecided->second);
  limit.found = true;
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
