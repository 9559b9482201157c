#include "solver/explain.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/number_text.hpp"
#include "solver/analysis/analysis_table.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/cyclic_reduction.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
namespace {

/// The first contact problem of a run and the model it belongs to.
struct FirstProblem {
  Model model;
  ContactSet contacts;
  StepProblem step;
  std::optional<ContactProblem> sector;  ///< what is solved instead of `step` in a model with cyclic symmetry

  const ContactProblem& solved() const { return sector ? *sector : step.problem; }
};

FirstProblem build_first_problem(const Case& scene, const Assembly& assembly) {
  const Analysis& analysis = scene.analysis;
  FirstProblem first{make_model(scene, assembly), {}, {}, {}};
  const State rest = state_at_rest(first.model);
  ContactDetector detector(assembly, detection_options(scene));
  first.contacts = contacts_at_rest(first.model, &detector);
  const ContactMemories memories = match_memories({}, first.contacts.points);
  first.step =
      analysis_traits(analysis.type).steps_in_time
          ? build_step_problem(first.model, rest, first.contacts, memories, simulation_options(scene).step)
          : first_static_problem(first.model, rest, first.contacts, memories, static_options(analysis));
  if (analysis_traits(analysis.type).one_solve && analysis.cyclic_sectors > 1)
    first.sector = reduce(first.step.problem,
                          find_cyclic_symmetry(first.model, rest, first.contacts, analysis.cyclic_sectors));
  return first;
}

int count_islands(const Model& model, const ContactSet& contacts) {
  const std::vector<int> islands = islands_of(model, contacts);
  int count = 0;
  for (size_t i = 0; i < islands.size(); ++i) count += islands[i] == static_cast<int>(i);
  return count;
}

int count_force_rows(const StepProblem& step, int rows_with_friction) {
  int rows = step.problem.num_contacts() - step.num_contacts;  // ties
  for (int i = 0; i < step.num_contacts; ++i) rows += step.problem.mu[i] > 0.0 ? rows_with_friction : 1;
  return rows;
}

/// `sectors`: 1 unless the model has cyclic symmetry.
ModelCounts count_model(const FirstProblem& first, int sectors) {
  ModelCounts counts;
  const Assembly& assembly = *first.model.assembly;
  counts.free_blocks = first.model.num_free();
  counts.fixed_blocks = static_cast<int>(assembly.blocks.size()) - counts.free_blocks;
  counts.parts =
      static_cast<int>(std::count_if(assembly.parts.begin(), assembly.parts.end(), [&](const Part& p) {
        return assembly.blocks[static_cast<size_t>(p.block)].kind != BlockKind::support;
      }));
  counts.unknowns = first.model.num_unknowns() / sectors;
  counts.contacts = first.step.num_contacts;
  counts.joints = number_joints(first.contacts).count;
  counts.ties = static_cast<int>(first.model.ties.size());
  counts.force_rows = count_force_rows(first.step, first.model.plane ? 2 : 3) / sectors;
  counts.islands = count_islands(first.model, first.contacts);
  return counts;
}

/// One line per feature that adds work to any analysis, with its value.
std::string active_features(const Case& scene, const ModelCounts& counts) {
  std::string text;
  const auto line = [&text](const std::string& name, const std::string& value) {
    text += fmt::format("    {:<12}{}\n", name, value);
  };
  const Analysis& analysis = scene.analysis;
  if (scene.joints.friction > 0.0)
    line("friction", fmt::format("{}, {}{}", scene.joints.friction, to_string(analysis.friction_law),
                                 analysis.dilatancy ? fmt::format(" ({:g})", *analysis.dilatancy) : ""));
  else
    line("friction", "none: normal forces only");
  line("compliance",
       fmt::format("{:g} normal and {:g} tangential per {}", scene.joints.compliance.normal,
                   scene.joints.compliance.tangential,
                   scene.joints.compliance.per == Compliance::Per::area ? "area (m3/N)" : "point (m/N)") +
           (scene.joints.compliance.relative
                ? fmt::format(", {:g} of a block's size", *scene.joints.compliance.relative)
                : ""));
  if (scene.joints.have_strength()) {
    const JointStrength& strength = scene.joints.strength;
    line("strength", fmt::format("tension {:g}, cohesion {:g}, compression {:g} Pa, {}; {} of each joint",
                                 strength.tension, strength.cohesion, strength.compression,
                                 to_string(scene.joints.failure),
                                 counted(scene.contact.subdivide * scene.contact.subdivide, "piece")));
  }
  if (analysis.plane)
    line("plane", "motion in x-z: three unknowns per block, one contact point instead of two");
  if (counts.ties > 0) line("ties", counted(counts.ties, "tie or strut", "ties and struts"));
  if (scene.supports.moving()) line("supports", "move");
  if (scene.contact.method == ContactDetection::Method::perturbed_gjk)
    line("contact", fmt::format("perturbed GJK, {} per pair of parts",
                                counted(scene.contact.perturbation.perturbations, "query", "queries")));
  return text;
}

std::string duration_text(double seconds) {
  return seconds < 120.0 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.2g} min", seconds / 60.0);
}

std::string cost_text(const CostEstimate& cost) {
  const bool complete = cost.left_out.empty();
  std::string text = fmt::format("  estimate    {}{} of processor time", complete ? "" : "at least ",
                                 duration_text(cost.seconds));
  if (!cost.basis.empty()) text += fmt::format(" ({})", cost.basis);
  text += fmt::format(", {:.0f} MB", cost.bytes / 1e6);
  if (cost.factor_entries > 0)
    text += fmt::format(", {} in the factor", counted(cost.factor_entries, "entry", "entries"));
  text += "\n";
  if (!complete) text += fmt::format("  left out    {}, and what follows it\n", cost.left_out);
  return text;
}

}  // namespace

ModelExplanation explain_model(const Case& scene, const Assembly& assembly, double time_limit) {
  ModelExplanation e;
  const FirstProblem first = build_first_problem(scene, assembly);
  e.counts = count_model(first, first.sector ? scene.analysis.cyclic_sectors : 1);
  e.cost = estimate_cost(scene, assembly, first.solved(), time_limit);
  const ModelCounts& c = e.counts;
  e.text = fmt::format("{} ({})\n", scene.title.empty() ? "untitled" : scene.title, scene.file);
  e.text += fmt::format("  blocks      {} free, {} fixed (no unknowns), {}, {}\n", c.free_blocks,
                        c.fixed_blocks, counted(c.parts, "convex part"), counted(c.islands, "island"));
  e.text += fmt::format("  unknowns    {}, {} at {} in {}\n", counted(c.unknowns, "velocity", "velocities"),
                        counted(c.force_rows, "force component"), counted(c.contacts, "contact"),
                        counted(c.joints, "joint"));
  e.text += fmt::format("  weight      {}; {} besides gravity\n", readable_force(first.model.free_weight),
                        counted(first.model.loads.points.size(), "point load"));
  const AnalysisTraits& traits = analysis_traits(scene.analysis.type);
  e.text += "  analysis    " + traits.describe(scene) + "\n";
  e.text += "  active\n" + active_features(scene, c) + traits.features(scene);
  e.text += cost_text(e.cost);
  return e;
}

}  // namespace cupola
