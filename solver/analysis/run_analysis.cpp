#include "solver/analysis/analysis.hpp"

namespace cupola {
namespace {

std::optional<Summary> run(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  switch (scene.analysis.type) {
    case AnalysisType::static_:
      return run_static(scene, assembly, sinks);
    case AnalysisType::dynamic:
      return run_dynamic(scene, assembly, sinks);
    case AnalysisType::staged:
      return scene.analysis.staged.independent_rings() ? run_staged(scene, assembly, sinks)
                                                       : run_construction(scene, assembly, sinks);
    case AnalysisType::limit:
      return run_limit(scene, assembly, sinks);
    case AnalysisType::range:
      return run_range(scene, assembly, sinks);
    case AnalysisType::path:
      return run_path(scene, assembly, sinks);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Summary> run_analysis(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  std::optional<Summary> summary = run(scene, assembly, sinks);
  if (!summary) return summary;
  summary->analysis = scene.analysis.type;
  summary->method = scene.analysis.method;
  summary->friction_law = scene.analysis.friction_law;
  summary->dilatancy = scene.analysis.dilatancy;
  summary->tangential = scene.analysis.tangential;
  return summary;
}

}  // namespace cupola
