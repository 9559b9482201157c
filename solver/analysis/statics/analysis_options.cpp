#include "solver/analysis/statics/analysis_options.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/dynamics/scene_options.hpp"

namespace cupola {

StaticOptions static_options(const Analysis& analysis) {
  StaticOptions options;
  options.tolerance = analysis.tolerance;
  options.solve = contact_solver_options(analysis);
  return options;
}

StaticOptions start_options(const Analysis& analysis) {
  constexpr double kStartTolerance = 1e-6;  // a residual in the start sets the structure in motion
  StaticOptions options = static_options(analysis);
  options.tolerance = std::min(analysis.tolerance, kStartTolerance);
  return options;
}

StaticOptions verdict_options(const Analysis& analysis) {
  StaticOptions options = static_options(analysis);
  options.tolerance = std::max(analysis.tolerance, kOutcomeTolerance);
  return options;
}

bool uses_direct_limit(const Analysis& analysis) {
  using Method = LimitSearch::Method;
  if (analysis.limit.method != Method::automatic) return analysis.limit.method == Method::direct;
  return analysis.limit.parameter != LimitSearch::Parameter::spread &&
         analysis.friction_law == FrictionLaw::associated;
}

bool changes_joints(LimitSearch::Parameter parameter) {
  using enum LimitSearch::Parameter;
  return parameter == friction || parameter == thickness || parameter == joint_extent;
}

double bracket_width(const Analysis& analysis) {
  if (analysis.limit.relative_width) return *analysis.limit.relative_width;
  if (!uses_direct_limit(analysis)) return 1e-3;
  return changes_joints(analysis.limit.parameter) ? 1e-4 : 1e-5;
}

std::string missed_width(double width, double asked) {
  return fmt::format("; bracket width {:.1e} of the middle > {:.1e} requested", width, asked);
}

int num_steps(const Analysis& analysis) {
  constexpr double kRounding = 1e-5;  // steps: 0.333333 s fits three times into 1 s
  return std::max(1, static_cast<int>(std::ceil(analysis.duration / analysis.time_step - kRounding)));
}

bool is_over(const Analysis& analysis, int steps, double time) {
  return analysis.adaptive ? time >= analysis.duration * (1.0 - 1e-12) : steps >= num_steps(analysis);
}

double step_limit(const Case& scene, const std::vector<KeyedTime>& times, double time) {
  const Analysis& analysis = scene.analysis;
  if (!analysis.adaptive) return analysis.time_step;
  const double every = scene.output.frames_every;
  double end = std::min((std::floor(time / every + 1e-9) + 1.0) * every, analysis.duration);
  for (const KeyedTime& of : times) end = std::min(end, next_corner(of.function, time));
  return end - time;
}

}  // namespace cupola
