#include "solver/analysis/analysis.hpp"

namespace cupola {

Summary run_analysis(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  Summary summary = scene.analysis.type == AnalysisType::static_ ? run_static(scene, assembly, sinks)
                                                                 : run_dynamic(scene, assembly, sinks);
  summary.method = "newton";
  summary.friction_law = "associated";
  summary.tangential = scene.analysis.tangential == TangentialSpring::memory ? "memory" : "literal";
  return summary;
}

}  // namespace cupola
