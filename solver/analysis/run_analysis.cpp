#include "solver/analysis/analysis.hpp"
#include "solver/analysis/analysis_table.hpp"

namespace cupola {
std::optional<Summary> run_analysis(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  std::optional<Summary> summary = analysis_traits(scene.analysis.type).run(scene, assembly, sinks);
  if (!summary) return summary;
  summary->analysis = scene.analysis.type;
  summary->method = scene.analysis.method;
  summary->friction_law = scene.analysis.friction_law;
  summary->dilatancy = scene.analysis.dilatancy;
  summary->tangential = scene.analysis.tangential;
  return summary;
}

}  // namespace cupola
