#include "solver/cost_estimate.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/process.hpp"
#include "solver/analysis/analysis_table.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/static_start.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/methods/method_table.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {
namespace {

/// Time of a static solve by Newton's method, in factorisations including assembly: the all-stick start, five
/// to eight iterations, then residuals, certificate and the frame. Measured on the models of the paper: 14 to
/// 17, walls 6 to 8.
constexpr double kFactorizationsPerSolve = 10.0;
/// The same for many blocks, in multigrid solves: a dozen iterations and more, with passes over the blocks,
/// and more iterations of conjugate gradients towards the end.
constexpr double kMultigridSolvesPerSolve = 26.0;
/// Passes over convex problems that zero compliance takes; each costs one static solve.
constexpr double kPasses = 4.0;
/// Time under Coulomb's law over that of the associated law, whose solution comes first, far from collapse.
/// Measured on the models of the paper at friction 0.4 and 0.15: 1.1 to 1.9.
constexpr double kCoulomb = 2.0;
constexpr int kTimedSteps = 3;         // of a motion, or equilibria of a path
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
    G.push_back(sticking_stiffness(law));
  }
  return assemble_hessian(white, graph, G);
}

/// Processor seconds of one assembly and factorisation after the first one, whose page faults take up to as
/// long again.
double time_factorization(const ContactProblem& problem, BlockCholesky* factor) {
  double started = 0.0;
  for (int k = 0; k < 2; ++k) {
    started = cpu_seconds();
    const WhitenedProblem white = whiten(problem);
    const ContactGraph graph = contact_graph(problem);
    if (factor->factorize(graph.pattern, sticking_hessian(problem, white, graph)))
      factor->solve(white.w_star);
  }
  return cpu_seconds() - started;
}

/// Processor seconds of one assembly and one search direction by conjugate gradients with multigrid. None if
/// the multigrid cannot be built.
std::optional<double> time_multigrid(const ContactProblem& problem) {
  constexpr double kForcing = 0.1;
  const double started = cpu_seconds();
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(problem);
  const RigidMotions motions = rigid_motions(white, graph);
  VecX d;
  SolveSummary summary;
  if (motions.empty() ||
      !NewtonDirection().solve_by_multigrid(graph.pattern, sticking_hessian(problem, white, graph), motions,
                                            white.w_star, kForcing, &d, &summary))
    return std::nullopt;
  return cpu_seconds() - started;
}

/// Whether directions come from conjugate gradients with multigrid, so that no factor is needed.
bool uses_multigrid(const Case& scene, const ContactProblem& problem) {
  return method_traits(scene.analysis.method).uses_multigrid && has_many_blocks(problem);
}

double num_passes(const Case& scene) {
  const bool rigid = scene.joints.compliance.normal == 0.0 || scene.joints.compliance.tangential == 0.0;
  if (rigid) return kPasses;
  return scene.analysis.friction_law == FrictionLaw::associated ? 1.0 : kCoulomb;
}

/// Adds the time of `work`, which the time limit may end, to the estimate. False if it did.
bool add_time(const std::string& what, const std::function<void()>& work, CostEstimate* cost) {
  const double started = cpu_seconds();
  bool ended = true;
  try {
    work();
  } catch (const Interrupted&) {
    ended = false;
  }
  const double taken = cpu_seconds() - started;
  cost->seconds += taken;
  if (!ended)
    cost->left_out = fmt::format("{}, which had not ended after {:.2g} s of processor time", what, taken);
  return ended;
}

void estimate_static(const Case& scene, const Assembly& assembly, const ContactProblem& problem,
                     CostEstimate* cost) {
  const double solves = num_passes(scene) * analysis_traits(scene.analysis.type).num_solves(scene, assembly);
  if (uses_multigrid(scene, problem)) {
    std::optional<double> once;
    if (!add_time(
            "a multigrid solve", [&] { once = time_multigrid(problem); }, cost))
      return;
    if (once) {
      cost->seconds = solves * kMultigridSolvesPerSolve * *once;
      cost->basis = fmt::format("one multigrid solve, {:.3g} s", *once);
      return;
    }
  }
  BlockCholesky factor;
  double once = 0.0;
  if (!add_time(
          "a factorisation", [&] { once = time_factorization(problem, &factor); }, cost))
    return;
  cost->factor_entries = factor.num_nonzeros();
  cost->seconds = solves * kFactorizationsPerSolve * once;
  cost->basis = fmt::format("one factorisation, {:.3g} s", once);
}

/// False if no motion follows.
bool estimate_start(const Case& scene, Simulation* simulation, CostEstimate* cost) {
  StaticStart start;
  const auto solve = [&] {
    start = start_from_equilibrium(
        scene, [](const std::string&) {}, simulation);
  };
  if (!add_time("the static start", solve, cost)) return false;
  cost->basis = fmt::format("static start, {:.3g} s", cost->seconds);
  if (start.solution.outcome == StaticOutcome::equilibrium) return true;
  cost->basis += ", which finds no equilibrium";
  return false;
}

void estimate_motion(const Case& scene, const Assembly& assembly, const ContactProblem& problem,
                     CostEstimate* cost) {
  Simulation simulation = make_simulation(scene, assembly);
  if (simulation.options().static_start && !estimate_start(scene, &simulation, cost)) return;
  const Analysis& analysis = scene.analysis;
  const double started = cpu_seconds();
  const auto done = [cost] { return static_cast<int>(cost->steps.size()); };
  const auto more = [&] {
    return done() < kTimedSteps && cpu_seconds() - started < kTimingBudget &&
           !is_over(analysis, done(), simulation.state().time);
  };
  while (more()) {
    const double before = cpu_seconds();
    StepReport report;
    const std::vector<KeyedTime> times = times_of(scene);
    const auto step = [&] { report = simulation.advance(step_limit(scene, times, simulation.state().time)); };
    if (!add_time(fmt::format("step {}", cost->steps.size() + 1), step, cost)) break;
    cost->steps.push_back({report.h, report.solve.iterations, cpu_seconds() - before});
  }
  if (cost->steps.empty()) return;
  const TimedStep& last = cost->steps.back();
  const double left = analysis.adaptive ? std::max(0.0, analysis.duration - simulation.state().time) / last.h
                                        : num_steps(analysis) - done();
  cost->seconds += left * last.seconds;
  if (!cost->basis.empty()) cost->basis += "; ";
  cost->basis += fmt::format("{}, the last of {:.3g} s in {:.3g} s", counted(cost->steps.size(), "step"),
                             last.h, last.seconds);
  const bool factors = method_traits(scene.analysis.method).uses_factor && !uses_multigrid(scene, problem);
  if (!factors || !cost->left_out.empty()) return;
  BlockCholesky factor;
  const double motion = cost->seconds;
  if (add_time(
          "a factorisation", [&] { time_factorization(problem, &factor); }, cost))
    cost->factor_entries = factor.num_nonzeros();
  cost->seconds = motion;
}

/// The first equilibria of a path, at time 0 and after two steps; these represent all that follow. Under
/// Coulomb's law a step in which joints slide takes tens of times as many iterations as the static solve.
void estimate_path(const Case& scene, const Assembly& assembly, CostEstimate* cost) {
  const double started = cpu_seconds();
  double share = 0.0, at_rest = 0.0;  // of the path; s, of the equilibrium at time 0
  int equilibria = 0;
  AnalysisSinks sinks;
  sinks.progress = [&](double done, const std::string&) {
    share = done;
    if (equilibria++ == 0) at_rest = cpu_seconds() - started;
  };
  sinks.interrupted = [&] { return equilibria == kTimedSteps || cpu_seconds() - started > kTimingBudget; };
  bool goes_on = false;
  add_time(
      "the first steps of the path", [&] { goes_on = !run_analysis(scene, assembly, sinks); }, cost);
  cost->basis = counted(equilibria, "equilibrium", "equilibria") + fmt::format(", {:.3g} s", cost->seconds);
  if (!goes_on) return;
  const double steps = analysis_traits(scene.analysis.type).num_solves(scene, assembly) - 1.0;
  cost->seconds += share > 0.0 ? (1.0 - share) / share * (cost->seconds - at_rest) : steps * at_rest;
}

}  // namespace

CostEstimate estimate_cost(const Case& scene, const Assembly& assembly, const ContactProblem& problem,
                           double time_limit) {
  const TimeLimit limit(time_limit);
  CostEstimate cost;
  if (analysis_traits(scene.analysis.type).steps_in_time)
    estimate_motion(scene, assembly, problem, &cost);
  else if (analysis_traits(scene.analysis.type).like_steps)
    estimate_path(scene, assembly, &cost);
  else
    estimate_static(scene, assembly, problem, &cost);
  cost.bytes = static_cast<double>(peak_memory_bytes());
  return cost;
}

}  // namespace cupola
