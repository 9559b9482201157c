#include "solver/analysis/statics/analysis_options.hpp"

#include <algorithm>
#include <cmath>

#include "solver/dynamics/scene_options.hpp"

namespace cupola {

StaticOptions static_options(const Analysis& analysis) {
  constexpr double kStartTolerance = 1e-6;  // a residual in the start sets the structure in motion
  StaticOptions options;
  options.tolerance = analysis.tolerance;
  options.solve = contact_solver_options(analysis);
  switch (analysis.type) {
    case AnalysisType::static_:
    case AnalysisType::range:
    case AnalysisType::path:
      break;
    case AnalysisType::dynamic:
      options.tolerance = std::min(analysis.tolerance, kStartTolerance);
      break;
    case AnalysisType::staged:
    case AnalysisType::limit:
      options.tolerance = std::max(analysis.tolerance, kOutcomeTolerance);
      break;
  }
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
  return changes_joints(analysis.limit.parameter) ? 1e-4 : 1e-6;
}

double num_equilibria(const Analysis& analysis, int num_rings) {
  switch (analysis.type) {
    case AnalysisType::static_:
    case AnalysisType::dynamic:
      return 1.0;
    case AnalysisType::staged:
      return 0.5 * std::max(2, num_rings);
    case AnalysisType::path:
      // The search for a time takes some seven solves of each contact problem.
      return 1.0 + (analysis.path.length ? 7.0 : 1.0) * analysis.path.steps;
    case AnalysisType::range:  // a conic programme takes the time of about four static solves
      return 1.0 + 8.0 * static_cast<double>(analysis.range.quantities.size());
    case AnalysisType::limit: {
      const LimitSearch& limit = analysis.limit;
      // A conic programme takes the time of about four static solves; three for loads, five for joints.
      if (uses_direct_limit(analysis)) return changes_joints(limit.parameter) ? 20.0 : 12.0;
      const double widest = std::max(std::abs(limit.low), std::abs(limit.high));
      const double halvings = std::log2((limit.high - limit.low) / (widest * bracket_width(analysis)));
      return 2.0 + std::ceil(std::max(0.0, halvings));
    }
  }
  return 1.0;
}

double step_limit(const Case& scene, double time) {
  const Analysis& analysis = scene.analysis;
  if (!analysis.adaptive) return analysis.time_step;
  const double every = scene.output.frames_every;
  const double next_frame = (std::floor(time / every + 1e-9) + 1.0) * every;
  return std::min(next_frame, analysis.duration) - time;
}

}  // namespace cupola
