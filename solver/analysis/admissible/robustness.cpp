#include "solver/analysis/admissible/robustness.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "assembly/case/limit_parameter.hpp"
#include "solver/analysis/admissible/rigid_scene.hpp"
#include "solver/analysis/statics/model_symmetry.hpp"
#include "solver/conic/opening_motion.hpp"
#include "solver/conic/solve_conic.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// Bounds of the critical acceleration in one direction.
struct DirectionLimit {
  bool found = false;
  double admissible = 0.0, moving = 0.0;
};

DirectionLimit limit_towards(const Case& scene, const RigidScene& rest, double azimuth) {
  Case pushed = scene;
  pushed.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  pushed.analysis.limit.direction = {std::cos(azimuth), std::sin(azimuth), 0.0};
  const Model model = make_model(case_at(pushed, 1.0), *rest.assembly);
  const ConicProblem problem = with_multiplier(
      rest.problem, applied_forces(model, rest.start, rest.start.time) - rest.problem.load, -1.0);
  ConicSolution solution = solve_conic(problem);
  if (solution.outcome == ConicOutcome::infeasible || solution.outcome == ConicOutcome::unbounded) return {};
  // Rounding may stall a solve whose bounds are close.
  constexpr double kClose = 1e-4;
  const ConicBounds bounds =
      multiplier_bounds(problem, 0.1 * kClose * std::abs(solution.multipliers[0]), &solution);
  if (!(bounds.relative_gap() <= kClose)) return {};
  return {true, -bounds.upper, -bounds.lower};
}

}  // namespace

std::optional<Robustness> find_robustness(const Case& scene, const Assembly& assembly) {
  constexpr double kWork = 1e12;  // of all directions: always worth all threads
  const int count = scene.analysis.robustness;
  // Time functions are frozen at their values at time 0, as in a limit analysis.
  const RigidScene rest =
      rigid_scene(scene, std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {}));
  // A rotation by a sector maps each direction on another one, with the same limit.
  const int different = count / std::gcd(count, num_equal_sectors(rest.model, rest.start, rest.contacts));
  std::vector<DirectionLimit> limits(static_cast<size_t>(different));
  share_loop(kWork, different, [&](int k) {
    for (int image = k; image < count && !limits[k].found; image += different)
      limits[k] = limit_towards(scene, rest, 2.0 * std::numbers::pi * image / count);
  });
  // Of directions that rounding does not distinguish, as by symmetry, the first counts.
  std::optional<Robustness> least;
  for (int k = 0; k < different; ++k)
    if (limits[k].found && (!least || limits[k].moving < least->acceleration_g))
      least = Robustness{count, limits[k].admissible, limits[k].moving, 360.0 * k / count};
  return least;
}

std::string describe(const Robustness& robustness) {
  return fmt::format(
      "; the least of {} horizontal accelerations that make it move is {:.4g} g, towards {:g} degrees",
      robustness.directions, robustness.moving_g, robustness.azimuth_deg);
}

}  // namespace cupola
