#include "solver/cost_estimate.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "solver/analysis/analysis_options.hpp"
#include "solver/analysis/static_start.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/methods/method_table.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
namespace {

/// Time of a static solve by Newton's method, in factorisations including assembly: the all-stick start, four
/// iterations, usually a single h, then residuals and the frame.
constexpr double kFactorizationsPerSolve = 6.0;
/// The same for many blocks, in multigrid solves: a dozen iterations and more, with passes over the blocks,
/// and more iterations of conjugate gradients towards the end.
constexpr double kMultigridSolvesPerSolve = 26.0;
/// Passes over convex problems that Coulomb's law and zero compliance take; each costs one static solve.
constexpr double kPasses = 4.0;
constexpr int kTimedSteps = 3;         // of a motion; the last one represents all that follow
constexpr double kTimingBudget = 5.0;  // s of processor time, after which no further step is timed

/// The Hessian in which every contact sticks.
BlockMatrix sticking_hessian(const ContactProblem& problem, const WhitenedProblem& white,
                             const ContactGraph& graph) {
  // A rigid contact is solved with a proximal term in place of its compliance.
  constexpr double kProximal = 1e-4;
  std::vector<Mat3> G;
  for (int i = 0; i < problem.num_contacts(); ++i) {
    ContactLaw law = contact_law(problem, i);
    law.e_n = law.e_n > 0.0 ? law.e_n : kProximal;
    law.e_t = law.e_t > 0.0 ? law.e_t : kProximal;
    G.push_back(contact_stiffness(law, -Vec3::UnitX()));
  }
  return assemble_hessian(white.problem, graph, G);
}

/// Processor seconds of one assembly and factorisation.
double time_factorization(const ContactProblem& problem, BlockCholesky* factor) {
  const double started = cpu_seconds();
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(white.problem);
  if (factor->factorize(graph.pattern, sticking_hessian(problem, white, graph)))
    factor->solve(white.problem.v_star);
  return cpu_seconds() - started;
}

/// Processor seconds of one assembly and one search direction by conjugate gradients with multigrid. None if
/// the multigrid cannot be built.
std::optional<double> time_multigrid(const ContactProblem& problem) {
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

double num_passes(const Case& scene) {
  const bool rigid = scene.joints.compliance.normal == 0.0 || scene.joints.compliance.tangential == 0.0;
  return scene.analysis.friction_law != FrictionLaw::associated || rigid ? kPasses : 1.0;
}

CostEstimate estimate_static(const Case& scene, const Assembly& assembly, const ContactProblem& problem) {
  CostEstimate cost;
  const double solves = num_equilibria(scene.analysis, assembly.num_rings) * num_passes(scene);
  if (method_traits(scene.analysis.method).uses_multigrid && has_many_blocks(problem)) {
    if (const std::optional<double> once = time_multigrid(problem)) {
      cost.seconds = solves * kMultigridSolvesPerSolve * *once;
      cost.basis = fmt::format("one multigrid solve, {:.3g} s", *once);
      return cost;
    }
  }
  BlockCholesky factor;
  const double once = time_factorization(problem, &factor);
  cost.factor_entries = factor.num_nonzeros();
  cost.seconds = solves * kFactorizationsPerSolve * once;
  cost.basis = fmt::format("one factorisation, {:.3g} s", once);
  return cost;
}

CostEstimate estimate_motion(const Case& scene, const Assembly& assembly, const ContactProblem& problem) {
  CostEstimate cost;
  Simulation simulation = make_simulation(scene, assembly);
  if (simulation.options().static_start) {
    const double started = cpu_seconds();
    const StaticStart start = start_from_equilibrium(
        scene, [](const std::string&) {}, &simulation);
    cost.seconds = cpu_seconds() - started;
    cost.basis = fmt::format("static start, {:.3g} s", cost.seconds);
    if (start.solution.outcome != StaticOutcome::equilibrium) {
      cost.basis += ", which finds no equilibrium";
      return cost;
    }
    cost.basis += "; ";
  }
  const double duration = scene.analysis.duration;
  double timed = 0.0;
  while (static_cast<int>(cost.steps.size()) < kTimedSteps && timed < kTimingBudget &&
         simulation.state().time < duration * (1.0 - 1e-12)) {
    const double started = cpu_seconds();
    const StepReport report = simulation.advance(step_limit(scene, simulation.state().time));
    cost.steps.push_back({report.h, report.solve.iterations, cpu_seconds() - started});
    timed += cost.steps.back().seconds;
  }
  cost.seconds += timed;
  const TimedStep& last = cost.steps.back();
  cost.seconds += std::max(0.0, duration - simulation.state().time) / last.h * last.seconds;
  cost.basis += fmt::format("{} step{}, the last of {:.3g} s in {:.3g} s", cost.steps.size(),
                            cost.steps.size() == 1 ? "" : "s", last.h, last.seconds);
  if (method_traits(scene.analysis.method).uses_factor) {
    BlockCholesky factor;
    time_factorization(problem, &factor);
    cost.factor_entries = factor.num_nonzeros();
  }
  return cost;
}

}  // namespace

CostEstimate estimate_cost(const Case& scene, const Assembly& assembly, const ContactProblem& problem) {
  CostEstimate cost = scene.analysis.type == AnalysisType::dynamic
                          ? estimate_motion(scene, assembly, problem)
                          : estimate_static(scene, assembly, problem);
  cost.bytes = static_cast<double>(peak_memory_bytes());
  return cost;
}

}  // namespace cupola
