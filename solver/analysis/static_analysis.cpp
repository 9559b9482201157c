#include "assembly/program.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record.hpp"
#include "solver/analysis/static_solve.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
Summary run_static(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, detection_options(scene));
  const ContactSet& contacts = detector.update(rest.poses);
  const ContactMemories memories = match_memories({}, contacts.contacts);

  StaticOptions options = static_options(scene.analysis);
  options.log = sinks.log;
  const double started = wall_seconds();
  std::optional<CyclicSymmetry> symmetry;
  if (scene.analysis.cyclic_sectors > 1) {
    symmetry = find_cyclic_symmetry(model, rest, contacts, scene.analysis.cyclic_sectors);
    options.symmetry = &*symmetry;
  }
  const StaticSolution solution = solve_static(model, rest, contacts, memories, options);

  Summary summary;
  summary.solve_time_seconds = wall_seconds() - started;
  const Frame frame = static_frame(model, rest, contacts, memories, solution, options);
  summarize_frame(frame, model, &summary);
  summarize_static(solution, options.tolerance, &summary);
  summary.analysis = "static";
  summary.unknowns /= scene.analysis.cyclic_sectors;
  sinks.frame(frame);
  sinks.problem(solution.step.problem, solution.solution.gamma);
  return summary;
}

}  // namespace cupola
