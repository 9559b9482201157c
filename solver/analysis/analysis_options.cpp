#include "solver/analysis/analysis_options.hpp"

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
      break;
    case AnalysisType::dynamic:
      options.tolerance = std::min(analysis.tolerance, kStartTolerance);
      break;
    case AnalysisType::staged:
    case AnalysisType::limit:
      options.tolerance = std::max(analysis.tolerance, kOutcomeTolerance);
      options.may_move = true;
      break;
  }
  return options;
}

double step_limit(const Case& scene, double time) {
  const Analysis& analysis = scene.analysis;
  if (!analysis.adaptive) return analysis.time_step;
  const double every = scene.output.frames_every;
  const double next_frame = (std::floor(time / every + 1e-9) + 1.0) * every;
  return std::min(next_frame, analysis.duration) - time;
}

}  // namespace cupola
