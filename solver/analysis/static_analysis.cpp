#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "solver/analysis/admissible/robustness.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/static_parts.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// A note for the message if displacements are large, because equilibrium is found on the geometry as built.
std::string linearity_note(const Assembly& assembly, double displacement) {
  constexpr double kSmall = 0.1;  // of the smallest free block
  double smallest = std::numeric_limits<double>::infinity();
  for (const Block& block : assembly.blocks)
    if (!block.fixed) smallest = std::min(smallest, std::cbrt(block.volume));
  if (displacement <= kSmall * smallest) return "";
  return fmt::format(
      "; the largest displacement of {:.2g} m is not small compared with the smallest block of {:.2g} m, but "
      "forces are those of the geometry as built. Check `joints.compliance`",
      displacement, smallest);
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
    contacts_at_rest(rest, assembly, &detector);
    return std::move(detector).take_contacts();
  }();
  sinks.as_built(contacts);
  release_freed_memory();
  const ContactMemories memories = memories_at_rest(model, rest, contacts.points);

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
  const Frame frame = static_frame(model, rest, contacts, memories, solution, options);
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
  if (summary.max_displacement_m) summary.message += linearity_note(assembly, *summary.max_displacement_m);
  if (scene.analysis.robustness > 0 && solution.outcome == StaticOutcome::equilibrium) {
    summary.robustness = find_robustness(scene, assembly);
    summary.message += summary.robustness ? describe(*summary.robustness)
                                          : "; no horizontal acceleration was found that makes it move";
  }
  if (solution.outcome != StaticOutcome::equilibrium && !symmetry && !wrench_error)
    if (const auto parts = solve_by_parts(model, rest, contacts, memories, options))
      add_parts(*parts, model, options, &summary, sinks);
  solution.step = {};  // for a large model as large as the frame, whose writing takes as much memory again
  sinks.frame(frame);
  return summary;
}

}  // namespace cupola
