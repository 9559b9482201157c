#include "solver/analysis/analysis_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/model/laying_course.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/dynamics/laying_order.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
namespace {

std::string feature(const char* name, const std::string& value) {
  return fmt::format("    {:<12}{}\n", name, value);
}

std::string no_features(const Case&) {
  return "";
}

double one_solve(const Case&, const Assembly&) {
  return 1.0;
}

// --- static

std::optional<Summary> run_as_built(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  return run_static(scene, assembly, sinks);
}

std::string describe_static(const Case& scene) {
  return fmt::format(
      "static, {}: contacts are detected once, no time integration; equilibrium residual at most {:.1e}",
      to_string(scene.analysis.method), scene.analysis.tolerance);
}

std::string static_features(const Case& scene) {
  const Analysis& analysis = scene.analysis;
  std::string text;
  if (analysis.cyclic_sectors > 1)
    text += feature("sectors", fmt::format("one of {} is solved", analysis.cyclic_sectors));
  if (analysis.friction_law != FrictionLaw::associated)
    text += feature("law",
                    "the associated problem is solved first; about twice its time, near collapse ten times");
  if (analysis.accuracy.wrench_error)
    text +=
        feature("accuracy", fmt::format("wrench error at most {:g}: several solves with decreasing tolerance",
                                        *analysis.accuracy.wrench_error));
  return text;
}

// --- dynamic

std::string describe_motion(const Case& scene) {
  const Analysis& analysis = scene.analysis;
  const std::string steps =
      analysis.adaptive
          ? fmt::format("{:g} s in adaptive steps, the first of {:g} s", analysis.duration,
                        analysis.time_step)
          : fmt::format("{} of {:g} s", counted(num_steps(analysis), "step"), analysis.time_step);
  return fmt::format("dynamic, {}: {}; contacts are updated where blocks have moved",
                     to_string(analysis.method), steps);
}

std::string motion_features(const Case& scene) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) { text += feature(name, value); };
  const SimulationOptions options = simulation_options(scene);
  line("tangential", options.step.tangential == TangentialSpring::memory ? "elastic slip is stored"
                                                                         : "literal scheme of the paper");
  if (options.step.recovery == Recovery::literal)
    line("recovery",
         fmt::format("literal scheme of the paper: contacts bear at most {:g} m/s times step over compliance",
                     options.step.recovery_speed));
  if (options.static_start)
    line("start", fmt::format("static equilibrium under the loads at time 0, residual at most {:.1e}",
                              start_options(scene.analysis).tolerance));
  if (options.adaptive)
    line("step",
         fmt::format("adaptive, {:g} to {:g} s, error at most {:g} m per step", options.adaptive->smallest,
                     options.adaptive->largest, options.adaptive->displacement_error));
  if (options.sleep)
    line("sleep", fmt::format("islands slower than {:g} m/s for {:g} s are left out of the problem",
                              options.sleep->speed, options.sleep->time));
  line("frames", fmt::format("every {:g} s", scene.output.frames_every));
  return text;
}

// --- staged

/// Each stage counts with its share of the free blocks, its course as if it were complete.
double solves_of_stages(const Case& scene, const Assembly& assembly) {
  constexpr double kSolvesPerSearch = 4.0;  // most stages confirm the bracket of the stage before
  const StagedConstruction& staged = scene.analysis.staged;
  const auto solved_with = [&](int course) {
    return std::ranges::count_if(assembly.blocks, [&](const Block& block) {
      return !block.fixed && laying_course(assembly, block) <= course &&
             !is_held(assembly, block, course, staged.hold_below);
    });
  };
  std::map<int, std::ptrdiff_t> stages;  // of each course
  for (const LaidBlocks& stage : laying_order(assembly, staged)) ++stages[stage.course];
  std::ptrdiff_t solved = 0;
  for (const auto& [course, count] : stages) solved += count * solved_with(course);
  const auto free = std::max<std::ptrdiff_t>(1, std::ranges::count(assembly.blocks, false, &Block::fixed));
  const double solves = static_cast<double>(solved) / static_cast<double>(free);
  return staged.least == StagedConstruction::Least::none ? solves : (1.0 + kSolvesPerSearch) * solves;
}

std::string describe_stages(const Case& scene) {
  const StagedConstruction& staged = scene.analysis.staged;
  return fmt::format(
      "staged, {}: one equilibrium per {}{}", to_string(scene.analysis.method),
      staged.unit == StagedConstruction::Unit::ring ? "ring" : "block of every team",
      staged.least == StagedConstruction::Least::none
          ? ""
          : fmt::format(", and a search for the least fresh {} of each", to_string(staged.least)));
}

// --- limit

/// A conic programme takes the time of about four static solves; three for loads, five for joints. A
/// bisection solves one for each end of the bracket and one per halving.
double solves_of_limit(const Case& scene, const Assembly&) {
  const LimitSearch& limit = scene.analysis.limit;
  if (uses_direct_limit(scene.analysis)) return changes_joints(limit.parameter) ? 20.0 : 12.0;
  const double widest = std::max(std::abs(limit.low), std::abs(limit.high));
  const double halvings = std::log2((limit.high - limit.low) / (widest * bracket_width(scene.analysis)));
  return 2.0 + std::ceil(std::max(0.0, halvings));
}

std::string describe_limit(const Case& scene) {
  const LimitSearch& limit = scene.analysis.limit;
  if (limit.parameter == LimitSearch::Parameter::peak_stress)
    return "limit, direct: a conic programme over all admissible states";
  if (uses_direct_limit(scene.analysis))
    return fmt::format("limit, direct: conic programmes over all admissible states between {:g} and {:g}",
                       limit.low, limit.high);
  return fmt::format("limit, {}: about {:.0f} equilibria between {:g} and {:g}",
                     to_string(scene.analysis.method), solves_of_limit(scene, {}), limit.low, limit.high);
}

// --- range

/// A conic programme takes the time of about four static solves.
double solves_of_range(const Case& scene, const Assembly&) {
  return 1.0 + 8.0 * static_cast<double>(scene.analysis.range.quantities.size());
}

std::string describe_range(const Case& scene) {
  return fmt::format(
      "range: one equilibrium by {}, and two conic programmes over all admissible states for each of {} "
      "quantities",
      to_string(scene.analysis.method), scene.analysis.range.quantities.size());
}

std::string range_features(const Case& scene) {
  if (scene.analysis.cyclic_sectors <= 1) return "";
  return feature("sectors", fmt::format("one of {} is solved for quantities that repeat around the axis",
                                        scene.analysis.cyclic_sectors));
}

// --- path

/// The search for a time takes some seven solves of each contact problem.
double solves_of_path(const Case& scene, const Assembly&) {
  const auto& path = scene.analysis.path;
  return 1.0 + (path.length ? 7.0 : 1.0) * path.steps;
}

std::string describe_path(const Case& scene) {
  const auto& path = scene.analysis.path;
  return fmt::format(
      "path, {}: {} up to {}{}", to_string(scene.analysis.method),
      counted(path.steps, "equilibrium", "equilibria"),
      path.length
          ? fmt::format("a control displacement of {:g} m, each at a time that is found by several solves",
                        *path.length)
          : fmt::format("the time {:g} s", path.end),
      scene.joints.failure == JointFailure::plastic ? "" : ", several solves where joints break");
}

// clang-format off
constexpr std::array<AnalysisTraits, 6> kAnalysisTable{{
    // type                   in time  many   like   one solve  state of the residuals                run           solves            in words
    {AnalysisType::static_,   false,   false, false, true,      "",                                   run_as_built, one_solve,        describe_static, static_features},
    {AnalysisType::dynamic,   true,    true,  true,  false,     "",                                   run_dynamic,  one_solve,        describe_motion, motion_features},
    {AnalysisType::staged,    false,   true,  false, false,     "",                                   run_staged,   solves_of_stages, describe_stages, no_features},
    {AnalysisType::limit,     false,   false, false, false,     " at the stable end of the bracket",  run_limit,    solves_of_limit,  describe_limit,  no_features},
    {AnalysisType::range,     false,   false, false, false,     "",                                   run_range,    solves_of_range,  describe_range,  range_features},
    {AnalysisType::path,      false,   true,  true,  false,     "",                                   run_path,     solves_of_path,   describe_path,   no_features},
}};
// clang-format on
static_assert(kAnalysisTable.size() == enum_names(AnalysisType{}).size());

}  // namespace

const AnalysisTraits& analysis_traits(AnalysisType type) {
  const auto row = std::find_if(kAnalysisTable.begin(), kAnalysisTable.end(),
                                [type](const AnalysisTraits& traits) { return traits.type == type; });
  CUPOLA_ASSERT(row != kAnalysisTable.end());
  return *row;
}

}  // namespace cupola
