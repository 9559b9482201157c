#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/case/case.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/model/results.hpp"
#include "solver/analysis/admissible/rigid_scene.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "solver/analysis/statics/model_symmetry.hpp"
#include "solver/analysis/statics/static_parts.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "solver/conic/opening_motion.hpp"
#include "solver/conic/solve_conic.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// The critical acceleration in one direction.
struct DirectionLimit {
  enum { undecided, none, found } outcome = undecided;
  double admissible = 0.0, moving = 0.0;  ///< g, its bounds
};

DirectionLimit limit_towards(const Case& scene, const RigidScene& rest, double azimuth) {
  Case pushed = scene;
  pushed.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  pushed.analysis.limit.direction = {std::cos(azimuth), std::sin(azimuth), 0.0};
  const Model model = make_model(case_at(pushed, 1.0), *rest.assembly);
  const ConicProblem problem = with_multiplier(
      rest.problem, applied_forces(model, rest.start, rest.start.time) - rest.problem.load, -1.0);
  ConicSolution solution = solve_conic(problem);
  if (solution.outcome == ConicOutcome::unbounded) return {DirectionLimit::none};
  if (solution.outcome == ConicOutcome::infeasible) return {};
  // Rounding may stall a solve whose bounds are close.
  constexpr double kClose = 1e-4;
  const ConicBounds bounds =
      multiplier_bounds(problem, 0.1 * kClose * std::abs(solution.multipliers[0]), &solution);
  // Bounds of zero are rounding, which has no small relative gap.
  const bool zero = std::max(std::abs(bounds.lower), std::abs(bounds.upper)) <= kZeroLimit;
  if (!zero && !(bounds.relative_gap() <= kClose)) return {};
  if (-bounds.lower <= kZeroLimit) return {DirectionLimit::found, 0.0, kZeroLimit};  // it stands at rest
  return {DirectionLimit::found, -bounds.upper, -bounds.lower};
}

/// The limits over `scene.analysis.robustness` directions.
struct DirectionLimits {
  int directions = 0, undecided = 0;
  double first_undecided_deg = 0.0;
  std::optional<Robustness> least = {};  ///< none if no direction has a limit
};

/// The least horizontal acceleration of all free blocks, over `scene.analysis.robustness` directions, for
/// which a mechanism proves that no admissible state exists: one conic programme each, which maximises the
/// multiplier of the loads that the acceleration adds.
DirectionLimits find_robustness(const Case& scene, const Assembly& assembly) {
  constexpr double kWork = 1e12;  // of all directions: always worth all threads
  const int count = scene.analysis.robustness;
  // Time functions are frozen at their values at time 0, as in a limit analysis.
  const RigidScene rest =
      rigid_scene(scene, std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {}));
  // A rotation by a sector maps each direction on another one, with the same limit.
  const int different = count / std::gcd(count, num_equal_sectors(rest.model, rest.start, rest.contacts));
  std::vector<DirectionLimit> limits(static_cast<size_t>(different));
  share_loop(kWork, different, [&](int k) {
    for (int image = k; image < count && limits[k].outcome == DirectionLimit::undecided; image += different)
      limits[k] = limit_towards(scene, rest, 2.0 * std::numbers::pi * image / count);
  });
  DirectionLimits all{.directions = count};
  for (int k = different - 1; k >= 0; --k)
    if (limits[k].outcome == DirectionLimit::undecided)
      all.undecided += count / different, all.first_undecided_deg = 360.0 * k / count;
  // Of directions that rounding does not distinguish, as by symmetry, the first counts.
  for (int k = 0; k < different; ++k)
    if (limits[k].outcome == DirectionLimit::found &&
        (!all.least || limits[k].moving < all.least->acceleration_g))
      all.least =
          Robustness{count - all.undecided, limits[k].admissible, limits[k].moving, 360.0 * k / count};
  return all;
}

/// What the search over all directions found.
Sought describe(const DirectionLimits& limits) {
  Sought sought{.quantity = "horizontal acceleration"};
  const std::string undecided =
      limits.undecided > 0
          ? fmt::format("{} of {} horizontal directions are undecided", limits.undecided, limits.directions)
          : "";
  if (limits.least) {
    const Robustness& least = *limits.least;
    sought.reason =
        least.acceleration_g == 0.0
            ? fmt::format("any horizontal acceleration towards {:g} degrees makes it move", least.azimuth_deg)
            : fmt::format(
                  "the least of {} horizontal accelerations that make it move is {:.4g} g, towards "
                  "{:g} degrees",
                  least.directions, least.moving_g, least.azimuth_deg);
    sought.also = undecided;
  } else if (!undecided.empty()) {
    sought.found = "unknown";
    sought.reason = undecided;
  } else {
    sought.found = "no limit";
    sought.reason =
        fmt::format("no horizontal acceleration in {} directions makes it move", limits.directions);
  }
  return sought;
}

/// The least that was found may not be the least of all; "" if every direction is decided.
std::string undecided_warning(const DirectionLimits& limits) {
  if (limits.undecided == 0 || (limits.least && limits.least->acceleration_g == 0.0)) return "";
  return fmt::format(
      "analysis.robustness: {} of {} directions are undecided, the first towards {:g} degrees: it may bear "
      "less there; ask with analysis.type: limit, parameter: acceleration and this direction",
      limits.undecided, limits.directions, limits.first_undecided_deg);
}

/// Solves with smaller and smaller tolerances until the certified error of every joint wrench is at most
/// `wrench_error`. If no error can be certified, or rounding prevents it, the outcome is `unconverged`.
StaticSolution solve_to_wrench_error(const Model& model, const State& start, const ContactSet& contacts,
                                     const ContactMemories& memories, StaticOptions options,
                                     double wrench_error) {
  constexpr double kReduction = 0.01;           // factor from one tolerance to the next
  constexpr double kSmallestTolerance = 1e-12;  // below it the momentum balance meets rounding
  StaticSolution solution;
  int iterations = 0;
  for (options.tolerance = kReduction * wrench_error; options.tolerance >= kSmallestTolerance;
       options.tolerance *= kReduction) {
    solution = solve_static(model, start, contacts, memories, options);
    iterations += std::exchange(solution.iterations, 0);
    if (solution.outcome != StaticOutcome::equilibrium) break;  // a smaller tolerance is not met either
    const ForceCertificate& error = solution.certificate.force_error;
    if (!error.value || *error.value <= wrench_error) break;
  }
  solution.iterations = iterations;
  if (solution.outcome != StaticOutcome::equilibrium) return solution;
  const ForceCertificate& error = solution.certificate.force_error;
  if (error.value && *error.value <= wrench_error) return solution;
  solution.outcome = StaticOutcome::unconverged;
  solution.message = error.value
                         ? fmt::format("wrench error {:.1e} > {:.1e} requested; ", *error.value, wrench_error)
                         : "the wrench error cannot be certified: " + error.bounds + "; ";
  solution.message += fmt::format("equilibrium residual {:.2e}", solution.balance.residual);
  return solution;
}

}  // namespace

Summary run_static(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  // The detector is destroyed at once: for a large model it is as large as the contact problem.
  const ContactSet contacts = [&] {
    ContactDetector detector(assembly, detection_options(scene));
    contacts_at_rest(model, &detector);
    return std::move(detector).take_contacts();
  }();
  sinks.as_built(contacts);
  release_freed_memory();
  const ContactMemories memories = match_memories({}, contacts.points);

  StaticOptions options = static_options(scene.analysis);
  options.log = sinks.log;
  const double started = wall_seconds();
  std::optional<CyclicSymmetry> symmetry;
  if (scene.analysis.cyclic_sectors > 1) {
    symmetry = find_cyclic_symmetry(model, rest, contacts, scene.analysis.cyclic_sectors);
    options.symmetry = &*symmetry;
  }
  const std::optional<double> wrench_error = scene.analysis.accuracy.wrench_error;
  StaticSolution solution =
      wrench_error ? solve_to_wrench_error(model, rest, contacts, memories, options, *wrench_error)
                   : solve_static(model, rest, contacts, memories, options);

  Summary summary;
  summary.solve_time_seconds = wall_seconds() - started;
  Frame frame = static_frame(model, rest, contacts, memories, solution, options);
  summarize_static(solution, frame, model, options.tolerance, &summary);
  if (wrench_error) {
    const double reached =
        solution.certificate.force_error.value.value_or(std::numeric_limits<double>::infinity());
    summary.accuracy = {"wrenches on the joints",
                        "largest certified error of a joint, relative to its wrench", *wrench_error, reached,
                        reached};
  }
  if (solution.certificate.balance == Balance::unstable)
    summary.warnings.emplace_back(
        "unstable balance: it stands as on an edge, and a small disturbance would end the equilibrium; how "
        "far it is from falling: cupola assess");
  summary.unknowns /= scene.analysis.cyclic_sectors;
  summary.message += gaps_note(model, rest, contacts);
  if (summary.max_displacement_m)
    warn_of_large_displacement(scene, assembly, *summary.max_displacement_m, &summary.warnings);
  if (scene.analysis.robustness > 0 && solution.outcome == StaticOutcome::equilibrium) {
    const DirectionLimits limits = find_robustness(scene, assembly);
    summary.robustness = limits.least;
    summary.sought = describe(limits);
    add_clause(clauses(*summary.sought), &summary.message);
    if (const std::string warning = undecided_warning(limits); !warning.empty())
      summary.warnings.push_back(warning);
  }
  if (solution.outcome != StaticOutcome::equilibrium && !symmetry && !wrench_error)
    if (const auto parts = solve_by_parts(model, rest, contacts, memories, options))
      add_parts(*parts, model, options, &summary, &frame, sinks);
  solution.step = {};  // for a large model as large as the frame, whose writing takes as much memory again
  sinks.frame(frame);
  return summary;
}

}  // namespace cupola
