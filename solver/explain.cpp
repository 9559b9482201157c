#include "solver/explain.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "solver/analysis/record.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/methods/method_table.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/simulation.hpp"

namespace cupola {
namespace {

/// Newton's method on a sound static problem: all-stick start and four iterations with one trial of h, then
/// residuals and the frame, together the time of so many factorisations with their assembly.
constexpr double kStaticSolves = 6.0;
/// The same of many blocks: a dozen iterations and more, with passes over the blocks and more gradients near
/// the end.
constexpr double kManyBlocksSolves = 26.0;
constexpr int kTimedSteps = 3;  // of a motion; the last of them stands for all that follow

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

/// The Hessian in which every contact sticks.
BlockMatrix sticking_hessian(const ContactProblem& problem, const WhitenedProblem& white,
                             const ContactGraph& graph) {
  std::vector<Mat3> G;
  for (int i = 0; i < problem.num_contacts(); ++i) {
    ContactLaw law = contact_law(problem, i);
    // A rigid contact is solved with a proximal term in place of its compliance.
    law.e_n = law.e_n > 0.0 ? law.e_n : 1e-4;
    law.e_t = law.e_t > 0.0 ? law.e_t : 1e-4;
    G.push_back(contact_stiffness(law, -Vec3::UnitX()));
  }
  return assemble_hessian(white.problem, graph, G);
}

/// One assembly and factorisation. Returns processor seconds.
double time_factorization(const ContactProblem& problem, BlockCholesky* factor) {
  const double started = cpu_seconds();
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(white.problem);
  if (factor->factorize(graph.pattern, sticking_hessian(problem, white, graph)))
    factor->solve(white.problem.v_star);
  return cpu_seconds() - started;
}

/// One assembly and one direction by a hierarchy; nothing where none can be made.
std::optional<double> time_direction(const ContactProblem& problem) {
  constexpr double kForcing = 0.1;
  const double started = cpu_seconds();
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(white.problem);
  const RigidMotions motions = rigid_motions(problem, graph, white.L);
  VecX d;
  SolveSummary summary;
  if (motions.empty() ||
      !NewtonDirection().solve_by_multigrid(graph.pattern, sticking_hessian(problem, white, graph), motions,
                                            white.problem.v_star, kForcing, &d, &summary))
    return std::nullopt;
  return cpu_seconds() - started;
}

struct Built {
  Model model;
  ContactSet contacts;
  StepProblem step;
};

Built build_first_step(const Case& scene, const Assembly& assembly) {
  Built built{make_model(scene, assembly), {}, {}};
  const State rest = state_at_rest(built.model);
  ContactDetector detector(assembly, detection_options(scene));
  built.contacts = detector.update(rest.poses);
  StepOptions options;
  options.h = scene.analysis.type == AnalysisType::static_ ? 100.0 : scene.analysis.time_step;
  options.time_advance = 0.0;
  built.step = build_step_problem(built.model, rest, built.contacts,
                                  match_memories({}, built.contacts.points), options);
  return built;
}

ModelCounts count_model(const Built& built) {
  ModelCounts counts;
  const Assembly& assembly = *built.model.assembly;
  counts.free_blocks = built.model.num_free();
  counts.fixed_blocks = static_cast<int>(assembly.blocks.size()) - counts.free_blocks;
  counts.parts = static_cast<int>(assembly.parts.size());
  counts.unknowns = built.model.num_unknowns();
  counts.contacts = built.step.num_contacts;
  counts.joints = number_joints(built.contacts).count;
  counts.ties = static_cast<int>(built.model.ties.size());
  counts.force_rows = count_force_rows(built.step, built.model.plane ? 2 : 3);
  counts.islands = count_islands(built.model, built.contacts);
  return counts;
}

/// Passes over convex problems that the Coulomb law and zero compliance take, each of a few factorisations.
double num_passes(const Case& scene) {
  const bool rigid = scene.joints.compliance.normal == 0.0 || scene.joints.compliance.tangential == 0.0;
  return scene.analysis.friction_law == FrictionLaw::coulomb || rigid ? 4.0 : 1.0;
}

double num_steps(const Analysis& analysis) {
  return std::ceil(analysis.duration / analysis.time_step);
}

/// Static solves of the whole model that the analysis takes: of a limit search one per halving of the
/// bracket, of a construction one per ring, half as large in the mean.
double num_equilibria(const Analysis& analysis, int num_rings) {
  if (analysis.type == AnalysisType::staged) return 0.5 * std::max(2, num_rings);
  if (analysis.type != AnalysisType::limit) return 1.0;
  const double widest = std::max(std::abs(analysis.limit.low), std::abs(analysis.limit.high));
  const double halvings =
      std::log2((analysis.limit.high - analysis.limit.low) / (widest * analysis.limit.relative_width));
  return 2.0 + std::ceil(std::max(0.0, halvings));
}

CostEstimate estimate_static(const Case& scene, const Built& built, ModelCounts* counts) {
  CostEstimate cost;
  const double equilibria = num_equilibria(scene.analysis, built.model.assembly->num_rings);
  if (method_traits(scene.analysis.method).uses_multigrid && has_many_blocks(built.step.problem)) {
    if (const std::optional<double> once = time_direction(built.step.problem)) {
      cost.seconds = equilibria * kManyBlocksSolves * num_passes(scene) * *once;
      cost.basis = fmt::format("one direction by the hierarchy, {:.3g} s", *once);
      return cost;
    }
  }
  BlockCholesky factor;
  const double once = time_factorization(built.step.problem, &factor);
  counts->factor_entries = factor.num_nonzeros();
  cost.seconds = equilibria * kStaticSolves * num_passes(scene) * once;
  cost.basis = fmt::format("one factorisation, {:.3g} s", once);
  return cost;
}

CostEstimate estimate_motion(const Case& scene, const Assembly& assembly, const Built& built,
                             ModelCounts* counts) {
  Simulation simulation = make_simulation(scene, assembly);
  CostEstimate cost;
  const double steps = num_steps(scene.analysis);
  double last = 0.0;
  for (int k = 0; k < kTimedSteps && k < steps; ++k) {
    const double started = cpu_seconds();
    simulation.advance();
    last = cpu_seconds() - started;
    cost.seconds += last;
  }
  cost.seconds += std::max(0.0, steps - kTimedSteps) * last;
  cost.basis = fmt::format("{} steps, the last {:.3g} s", kTimedSteps, last);
  if (method_traits(scene.analysis.method).uses_factor) {
    BlockCholesky factor;
    time_factorization(built.step.problem, &factor);
    counts->factor_entries = factor.num_nonzeros();
  }
  return cost;
}

/// One line per feature that costs something, with what asked for it.
std::string active_features(const Case& scene, const ModelCounts& counts) {
  std::string text;
  const auto line = [&text](const std::string& name, const std::string& why) {
    text += fmt::format("    {:<12}{}\n", name, why);
  };
  const Analysis& analysis = scene.analysis;
  if (scene.joints.friction > 0.0)
    line("friction", fmt::format("{}, {}", scene.joints.friction, to_string(analysis.friction_law)));
  else
    line("friction", "none: normal forces only");
  line("compliance",
       fmt::format("{:g} and {:g} per {}", scene.joints.compliance.normal, scene.joints.compliance.tangential,
                   scene.joints.compliance.per == Compliance::Per::area ? "area (m3/N)" : "point (m/N)"));
  if (analysis.plane) line("plane", "motion in x-z: three unknowns per block, one contact point for two");
  if (counts.ties > 0) line("ties", fmt::format("{} ties and struts", counts.ties));
  if (scene.supports.moving()) line("supports", "move");
  if (scene.contact.method == ContactDetection::Method::perturbed_gjk)
    line("contact", fmt::format("perturbed GJK, {} queries per pair of parts",
                                scene.contact.perturbation.perturbations));
  if (analysis.type == AnalysisType::dynamic) {
    line("tangential", analysis.tangential == TangentialSpring::memory ? "springs remember their slip"
                                                                       : "the paper's literal scheme");
    if (analysis.adaptive) line("step", "follows the motion");
    if (analysis.sleep)
      line("sleep", fmt::format("islands slower than {:g} m/s for {:g} s leave the problem",
                                analysis.sleep->speed, analysis.sleep->time));
    line("frames", fmt::format("every {:g} s", scene.output.frames_every));
  }
  return text;
}

std::string analysis_line(const Analysis& analysis) {
  const std::string method = to_string(analysis.method);
  switch (analysis.type) {
    case AnalysisType::static_:
      return fmt::format(
          "static, {}: nothing is integrated, contacts are found once; equilibrium residual {:.1e}", method,
          analysis.tolerance);
    case AnalysisType::dynamic:
      return fmt::format(
          "dynamic, {}: {:.0f} steps of {:g} s, contacts are found again where something moved", method,
          num_steps(analysis), analysis.time_step);
    case AnalysisType::staged:
      return fmt::format("staged, {}: an equilibrium ring by ring", method);
    case AnalysisType::limit:
      return fmt::format("limit, {}: about {:.0f} equilibria between {:g} and {:g}", method,
                         num_equilibria(analysis, 0), analysis.limit.low, analysis.limit.high);
  }
  return "";
}

std::string duration_text(double seconds) {
  return seconds < 120.0 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.2g} min", seconds / 60.0);
}

}  // namespace

ModelExplanation explain_model(const Case& scene, const Assembly& assembly) {
  ModelExplanation e;
  const Built built = build_first_step(scene, assembly);
  e.counts = count_model(built);
  e.cost = scene.analysis.type == AnalysisType::dynamic ? estimate_motion(scene, assembly, built, &e.counts)
                                                        : estimate_static(scene, built, &e.counts);
  e.cost.bytes = static_cast<double>(peak_memory_bytes());
  const ModelCounts& c = e.counts;
  e.text = fmt::format("{} ({})\n", scene.title.empty() ? "untitled" : scene.title, scene.file);
  e.text += fmt::format("  blocks      {} free, {} fixed (no unknowns), {} convex parts, {} island(s)\n",
                        c.free_blocks, c.fixed_blocks, c.parts, c.islands);
  e.text += fmt::format("  unknowns    {} velocities, {} force components at {} contacts in {} joints\n",
                        c.unknowns, c.force_rows, c.contacts, c.joints);
  e.text += fmt::format("  weight      {:.6e} N; {} point loads besides gravity\n", built.model.free_weight,
                        built.model.loads.points.size());
  e.text += "  analysis    " + analysis_line(scene.analysis) + "\n";
  e.text += "  active\n" + active_features(scene, c);
  e.text += fmt::format("  estimate    {} of processor time ({}), {:.0f} MB", duration_text(e.cost.seconds),
                        e.cost.basis, e.cost.bytes / 1e6);
  if (c.factor_entries > 0) e.text += fmt::format(", {} entries in the factor", c.factor_entries);
  e.text += "\n";
  return e;
}

}  // namespace cupola
