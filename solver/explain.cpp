#include "solver/explain.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/number_text.hpp"
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
  first.contacts = analysis.type == AnalysisType::static_ ? contacts_at_rest(rest, assembly, &detector)
                                                          : detector.update(rest.poses);
  const ContactMemories memories = match_memories({}, first.contacts.points);
  first.step =
      analysis.type == AnalysisType::dynamic
          ? build_step_problem(first.model, rest, first.contacts, memories, simulation_options(scene).step)
          : first_static_problem(first.model, rest, first.contacts, memories, static_options(analysis));
  if (analysis.type == AnalysisType::static_ && analysis.cyclic_sectors > 1)
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

/// One line per feature that adds work, with its value.
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
                   scene.joints.compliance.per == Compliance::Per::area ? "area (m3/N)" : "point (m/N)"));
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
  if (analysis.cyclic_sectors > 1)
    line("sectors",
         fmt::format(
             "one of {} is solved{}", analysis.cyclic_sectors,
             analysis.type == AnalysisType::range ? " for quantities that repeat around the axis" : ""));
  return text;
}

std::string static_features(const Analysis& analysis) {
  std::string text;
  if (analysis.friction_law != FrictionLaw::associated)
    text +=
        "    law         the associated problem is solved first; about twice its time, near collapse ten "
        "times\n";
  if (analysis.accuracy.wrench_error)
    text +=
        fmt::format("    accuracy    wrench error at most {:g}: several solves with decreasing tolerance\n",
                    *analysis.accuracy.wrench_error);
  return text;
}

std::string motion_features(const Case& scene) {
  std::string text;
  const auto line = [&text](const std::string& name, const std::string& value) {
    text += fmt::format("    {:<12}{}\n", name, value);
  };
  const SimulationOptions options = simulation_options(scene);
  line("tangential", options.step.tangential == TangentialSpring::memory ? "elastic slip is stored"
                                                                         : "literal scheme of the paper");
  if (options.step.recovery == Recovery::literal)
    line("recovery",
         fmt::format("literal scheme of the paper: contacts bear at most {:g} m/s times step over compliance",
                     options.step.recovery_speed));
  if (options.static_start)
    line("start", fmt::format("static equilibrium under the loads at time 0, residual at most {:.1e}",
                              static_options(scene.analysis).tolerance));
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

std::string analysis_line(const Case& scene) {
  const Analysis& analysis = scene.analysis;
  const std::string method = to_string(analysis.method);
  switch (analysis.type) {
    case AnalysisType::static_:
      return fmt::format(
          "static, {}: contacts are detected once, no time integration; equilibrium residual at most {:.1e}",
          method, analysis.tolerance);
    case AnalysisType::dynamic:
      if (analysis.adaptive)
        return fmt::format(
            "dynamic, {}: {:g} s in adaptive steps, the first of {:g} s; contacts are updated where "
            "blocks have moved",
            method, analysis.duration, analysis.time_step);
      return fmt::format(
          "dynamic, {}: {} of {:g} s; contacts are updated where blocks have moved", method,
          counted(static_cast<long long>(std::ceil(analysis.duration / analysis.time_step)), "step"),
          analysis.time_step);
    case AnalysisType::staged:
      return fmt::format(
          "staged, {}: one equilibrium per {}{}", method,
          analysis.staged.unit == StagedConstruction::Unit::ring ? "ring" : "block of every team",
          analysis.staged.least == StagedConstruction::Least::none
              ? ""
              : fmt::format(", and a search for the least fresh {} of each",
                            to_string(analysis.staged.least)));
    case AnalysisType::path:
      return fmt::format(
          "path, {}: {} up to {}{}", method, counted(analysis.path.steps, "equilibrium", "equilibria"),
          analysis.path.length
              ? fmt::format("a control displacement of {:g} m, each at a time that is found by "
                            "several solves",
                            *analysis.path.length)
              : fmt::format("the time {:g} s", analysis.path.end),
          scene.joints.failure == JointFailure::plastic ? "" : ", several solves where joints break");
    case AnalysisType::range:
      return fmt::format(
          "range: one equilibrium by {}, and two conic programmes over all admissible states for each of {} "
          "quantities",
          method, analysis.range.quantities.size());
    case AnalysisType::limit:
      if (uses_direct_limit(analysis))
        return fmt::format("limit, direct: conic programmes over all admissible states between {:g} and {:g}",
                           analysis.limit.low, analysis.limit.high);
      return fmt::format("limit, {}: about {:.0f} equilibria between {:g} and {:g}", method,
                         num_equilibria(analysis, 0), analysis.limit.low, analysis.limit.high);
  }
  return "";
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
  e.text += "  analysis    " + analysis_line(scene) + "\n";
  e.text += "  active\n" + active_features(scene, c);
  if (scene.analysis.type == AnalysisType::static_) e.text += static_features(scene.analysis);
  if (scene.analysis.type == AnalysisType::dynamic) e.text += motion_features(scene);
  e.text += cost_text(e.cost);
  return e;
}

}  // namespace cupola
