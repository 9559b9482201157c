#include "solver/contact/methods/newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "solver/contact/methods/block_descent.hpp"
#include "solver/contact/methods/primal_cost.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

std::vector<Mat3> stiffnesses(const ContactProblem& p, const VecX& y) {
  constexpr double kOperationsPerContact = 100.0;
  const int nc = p.num_contacts();
  std::vector<Mat3> G(nc);
  share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) G[i] = contact_stiffness(contact_law(p, i), y.segment<3>(3 * i));
  });
  return G;
}

/// The iterate of the smallest residual.
class BestIterate {
 public:
  BestIterate(const PrimalPoint& point, double residual) : w_(point.w), residual_(residual) {}
  void include(const PrimalPoint& point, double residual) {
    if (!(residual < residual_)) return;
    residual_ = residual;
    w_ = point.w;
  }
  double residual() const { return residual_; }
  const VecX& w() const { return w_; }

 private:
  VecX w_;
  double residual_;
};

/// Whether iterations still gain.
class Stagnation {
 public:
  explicit Stagnation(double residual) : largest_(residual), best_since_largest_(residual) {}

  /// `gained`: the cost fell, or the residual fell clearly below its best value.
  void include(bool gained, double residual) {
    without_gain_ = gained ? 0 : without_gain_ + 1;
    constexpr double kFalls = 0.99;  // by less than a hundredth is no fall
    const bool is_best = residual < kFalls * best_since_largest_ || residual > largest_;
    since_best_ = is_best ? 0 : since_best_ + 1;
    if (is_best) best_since_largest_ = residual;
    largest_ = std::max(largest_, residual);
  }
  /// Residuals may rise for some iterations while the cost decreases, but not for this many.
  bool is_final() const { return without_gain_ >= 12; }
  /// Multigrid misses very soft modes. It is given up after so many iterations without a residual below all
  /// since the largest: from a good guess the residual rises at first, by a factor of up to 100. Brick domes
  /// take up to ten.
  static constexpr int kMultigridLimit = 15;
  bool ends_multigrid() const { return since_best_ >= kMultigridLimit; }

 private:
  double largest_, best_since_largest_;
  int without_gain_ = 0, since_best_ = 0;
};

/// State of one solve, shared by the stages of the loop.
struct NewtonLoop {
  const WhitenedProblem& white;
  const SolveOptions& options;
  ContactGraph graph;
  double residual_scale;  ///< momentum residual of one unit of block gradient
  NewtonDirection& solver;
  SolveSummary& summary;
  RigidMotions motions{};  ///< of the blocks; empty: no multigrid
  std::optional<BlockDescent> descent{};

  double residual(const PrimalPoint& point) const { return point.largest_block_gradient * residual_scale; }

  bool uses_multigrid() const { return options.multigrid.value_or(has_many_blocks(white.given)); }
  bool lags_factor() const { return options.lag_factor && motions.empty(); }
  int max_iterations() const { return options.max_iterations.value_or(kNewtonIterations); }
  bool all_stick_start(VecX* w);
  bool solve(const BlockMatrix& H, const VecX& rhs, double forcing, VecX* x);
  double forcing(double residual, double last_residual) const;
  bool direction(const PrimalPoint& point, double last_residual, VecX* d);
  PrimalPoint run(PrimalPoint point);
  bool should_stop(const PrimalPoint& point, double best_residual, const Stagnation& stagnation);
};

/// Solves with all contacts sticking, including those with a gap. With open gaps this is a far better start
/// than free fall: a static dome with gaps of 1e-4 m takes 19 iterations instead of 61.
bool NewtonLoop::all_stick_start(VecX* w) {
  constexpr double kForcing = 1e-2;
  const ContactProblem& p = white.given;
  std::vector<Mat3> G(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i) G[i] = sticking_stiffness(contact_law(p, i));
  VecX impulse(p.b.size());
  for (int i = 0; i < p.num_contacts(); ++i) impulse.segment<3>(3 * i) = -G[i] * p.b.segment<3>(3 * i);
  const VecX rhs = white.w_star + generalized_impulse(white, impulse);
  return solve(assemble_hessian(white, graph, G), rhs, kForcing, w) && w->allFinite();
}

bool NewtonLoop::solve(const BlockMatrix& H, const VecX& rhs, double forcing, VecX* x) {
  if (!motions.empty()) {
    if (solver.solve_by_multigrid(graph.pattern, H, motions, rhs, forcing, x, &summary)) return true;
    motions = {};  // it will not succeed later either
  }
  return solver.solve_directly(graph.pattern, H, rhs, x, &summary);
}

/// Relative residual to which CG solves for the direction: not beyond what the tolerance requires, coarse
/// while the Newton residual decreases slowly, and at most two digits, as the active set changes from step to
/// step.
double NewtonLoop::forcing(double residual, double last_residual) const {
  constexpr double kLoosest = 0.1, kTwoDigits = 1e-2, kThreeDigits = 1e-3, kShare = 0.3;
  const double required = kShare * options.tolerance / residual;
  if (lags_factor()) return std::clamp(required, kThreeDigits, kLoosest);
  const double reduction = residual / last_residual;
  return std::clamp(std::max(required, 0.5 * reduction * reduction), kTwoDigits, kLoosest);
}

bool NewtonLoop::direction(const PrimalPoint& point, double last_residual, VecX* d) {
  const BlockMatrix H = assemble_hessian(white, graph, stiffnesses(white.given, point.y));
  const double relative_tolerance = forcing(residual(point), last_residual);
  if (lags_factor() &&
      solver.solve_lagged(graph.pattern, H, -point.gradient, relative_tolerance, d, &summary))
    return true;
  return solve(H, -point.gradient, relative_tolerance, d);
}

bool NewtonLoop::should_stop(const PrimalPoint& point, double best_residual, const Stagnation& stagnation) {
  if (residual(point) <= options.tolerance) {
    summary.ending = SolveEnding::converged;
    summary.message = fmt::format("momentum residual {:.2e} <= tolerance {:.2e} after {}", residual(point),
                                  options.tolerance, counted(summary.iterations, "iteration"));
    return true;
  }
  if (!std::isfinite(residual(point)) || !std::isfinite(point.cost)) {
    summary.ending = SolveEnding::failed;
    summary.message =
        fmt::format("Newton failed: the cost became {} in iteration {}", point.cost, summary.iterations);
    return true;
  }
  if (stagnation.is_final()) {
    summary.ending = SolveEnding::stalled;
    summary.message =
        fmt::format("Newton stalled: momentum residual {:.2e} above the tolerance {:.2e} after {}",
                    best_residual, options.tolerance, counted(summary.iterations, "iteration"));
    return true;
  }
  if (summary.iterations >= max_iterations()) {
    summary.ending = SolveEnding::max_iterations;
    summary.message = fmt::format("momentum residual {:.2e} > tolerance {:.2e} after {}", best_residual,
                                  options.tolerance, counted(summary.iterations, "iteration"));
    return true;
  }
  return false;
}

PrimalPoint NewtonLoop::run(PrimalPoint point) {
  constexpr double kCostRounding = 4e-16;
  constexpr double kFlat = 0.1;  // share of the slope below which the next direction gains more
  // From this iteration on block descent follows also the directions that come from factors. Of steps from
  // rest with much sliding it saves half the time and more. Most solves end before.
  constexpr int kSlow = 10;
  // Gradient of a block that BlockDescent skips: of the tolerance, and of the largest
  constexpr double kNegligible = 0.1, kSmallShare = 0.01;
  double last_residual = residual(point);
  BestIterate best(point, last_residual);
  Stagnation stagnation(last_residual);
  while (true) {
    summary.residual_history.push_back(residual(point));
    if (should_stop(point, best.residual(), stagnation)) break;
    if (!motions.empty() && stagnation.ends_multigrid()) {
      motions = {};
      summary.ending = SolveEnding::stalled;
      summary.message = fmt::format("multigrid-preconditioned CG made no progress for {}",
                                    counted(Stagnation::kMultigridLimit, "iteration"));
      break;
    }

    throw_if_interrupted();
    // 1. Newton direction, or steepest descent if rounding has spoiled it
    ++summary.iterations;
    VecX d;
    if (!direction(point, last_residual, &d)) {
      summary.ending = SolveEnding::failed;
      summary.message = fmt::format("the Hessian is not positive definite in double precision (iteration {})",
                                    summary.iterations);
      break;
    }
    if (!(d.dot(point.gradient) < 0.0)) d = -point.gradient;

    // 2. Step: the full direction if the slope at its end is small, otherwise a line search
    PrimalPoint next = primal_point(white, point.w + d);
    if (!(std::abs(d.dot(next.gradient)) <= kFlat * std::abs(d.dot(point.gradient)))) {
      const LineSearchResult search = line_search(white, point, d, kFlat);
      summary.line_search_evaluations += search.evaluations;
      if (search.t != 1.0) next = primal_point(white, point.w + search.t * d);
    }

    // 3. Block descent for the few contacts that would otherwise delay the whole structure
    const bool slow = !motions.empty() || summary.iterations >= kSlow;
    if (slow && residual(next) > options.tolerance) {
      if (!descent) descent.emplace(white);
      next = descent->descend(next, std::max(kNegligible * options.tolerance / residual_scale,
                                             kSmallShare * next.largest_block_gradient));
    }

    // 4. Progress
    const bool cost_fell = next.cost < point.cost * (1.0 - kCostRounding);
    const bool residual_fell = residual(next) < 0.9 * best.residual();
    last_residual = residual(point);
    point = std::move(next);
    stagnation.include(cost_fell || residual_fell, residual(point));
    best.include(point, residual(point));
  }
  return residual(point) == best.residual() ? point : primal_point(white, best.w());
}

SolveSummary failed(const std::string& message) {
  SolveSummary summary;
  summary.message = message;
  return summary;
}

}  // namespace

bool has_many_blocks(const ContactProblem& problem) {
  constexpr int kMany = 10000;
  return problem.num_blocks() >= kMany && !problem.plane;
}

int usual_newton_iterations(const ContactProblem& problem) {
  return has_many_blocks(problem) ? 60 : 25;
}

SolveSummary NewtonSolver::solve(const ContactProblem& problem, const SolveOptions& options,
                                 ContactSolution* solution) {
  options.validate();
  if (const std::string defect = problem.defect(); !defect.empty()) return failed(defect);
  if (const std::optional<int> rigid = first_rigid_contact(problem))
    return failed(fmt::format(
        "contact {} has zero compliance: Newton's method requires a compliance above zero", *rigid));

  const WhitenedProblem white = whiten(problem);
  SolveSummary summary;
  NewtonLoop loop{
      white,      options, contact_graph(problem), 1.0 / (root_mean_mass(problem) * options.reference_speed),
      direction_, summary};
  direction_.forget_multigrid();
  if (loop.uses_multigrid()) loop.motions = rigid_motions(white, loop.graph);
  VecX w;
  const auto set_start = [&] {
    const bool warm = solution->v.size() == problem.v_star.size();
    if (warm) w = white.to_w(solution->v);
    if (!warm && problem.num_contacts() == 0) w = white.w_star;
    return warm || problem.num_contacts() == 0 || loop.all_stick_start(&w);
  };
  if (!set_start())
    return failed("the Hessian of the sticking contacts is not positive definite in double precision");
  const bool by_multigrid = !loop.motions.empty();
  PrimalPoint point = loop.run(primal_point(white, w));
  if (by_multigrid && loop.motions.empty() && summary.ending == SolveEnding::stalled && set_start())
    point = loop.run(primal_point(white, std::move(w)));  // again, with factors
  summary.reached = loop.residual(point);
  solution->v = white.to_v(point.w);
  solution->gamma = point.gamma;
  CUPOLA_ASSERT(!summary.usable() || (solution->v.allFinite() && solution->gamma.allFinite()));
  return summary;
}

}  // namespace cupola
