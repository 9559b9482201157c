#include "solver/contact/newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "assembly/program.hpp"
#include "solver/contact/block_descent.hpp"
#include "solver/contact/cone.hpp"
#include "solver/contact/primal_cost.hpp"
#include "solver/contact/residuals.hpp"
#include "solver/contact/whitening.hpp"

namespace cupola {

namespace {

std::string rigid_contact(const ContactProblem& p) {
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (p.E[3 * i] > 0.0 && (p.mu[i] == 0.0 || p.E[3 * i + 1] > 0.0)) continue;
    return fmt::format("contact {} has zero compliance, which Newton's method cannot take: use `proximal`",
                       i);
  }
  return {};
}

std::vector<Mat3> stiffnesses(const ContactProblem& p, const VecX& y) {
  std::vector<Mat3> G(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i) G[i] = contact_stiffness(contact_law(p, i), y.segment<3>(3 * i));
  return G;
}

/// State of one solve: what the numbered stages of the loop share.
struct NewtonLoop {
  const ContactProblem& p;  ///< whitened
  const SolveOptions& options;
  ContactGraph graph;
  double residual_scale;  ///< momentum residual of one unit of block gradient
  NewtonDirection& solver;
  SolveSummary& summary;
  bool warm = false;                              ///< started from a guess
  bool lag_failed = false;                        ///< a kept factor was not near enough
  std::vector<ContactRegion> regions{};           ///< of the contacts, kept where a factor is dear
  std::vector<ContactRegion> factored_regions{};  ///< when the factor was made
  std::optional<BlockDescent> descent{};

  double residual(const PrimalPoint& point) const { return point.largest_block_gradient * residual_scale; }

  /// A factorisation costs so much that gradients with a kept factor, and passes over the blocks, are cheap.
  bool factor_is_dear() const { return !options.lag_factor && solver.affordable_gradients() > 0; }
  /// Where they are cheap, so are two more digits: what equilibrium of a large structure then has to spare.
  double tolerance() const { return (factor_is_dear() ? 1e-2 : 1.0) * options.tolerance; }
  int max_iterations() const { return options.max_iterations > 0 ? options.max_iterations : 100; }
  bool all_stick_start(VecX* w);
  bool factor_is_near(int affordable) const;
  bool direction(const PrimalPoint& point, VecX* d);
  PrimalPoint run(PrimalPoint point);
  bool should_stop(const PrimalPoint& point, double best_residual, int iterations_without_gain);
};

/// Solves as if every contact stuck to what it touches or hovers over. With open gaps this is far better than
/// letting the blocks fall first: a static dome with gaps of 1e-4 m takes 19 iterations instead of 61.
bool NewtonLoop::all_stick_start(VecX* w) {
  VecX closing = VecX::Zero(p.b.size());  // straight into the contact: it sticks
  for (int i = 0; i < p.num_contacts(); ++i) closing[3 * i] = -1.0;
  const std::vector<Mat3> G = stiffnesses(p, closing);
  VecX impulse(p.b.size());
  for (int i = 0; i < p.num_contacts(); ++i) impulse.segment<3>(3 * i) = -G[i] * p.b.segment<3>(3 * i);
  const VecX rhs = p.v_star + generalized_impulse(p, impulse);
  return solver.solve_directly(graph.pattern, assemble_hessian(p, graph, G), rhs, w, &summary) &&
         w->allFinite();
}

/// Whether the kept factor is near enough to be worth a try with that many gradients.
bool NewtonLoop::factor_is_near(int affordable) const {
  constexpr int kContactsPerGradient = 4;  // those that change lie together, and share what they change
  if (options.lag_factor) return true;
  if (affordable == 0) return false;
  // A cold start has left the factor in which all contacts stick: too far from the first Hessian.
  if (!lag_failed && (warm || summary.iterations > 1)) return true;
  if (factored_regions.empty()) return false;
  int changed = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) changed += regions[i] != factored_regions[i];
  return changed <= kContactsPerGradient * affordable;
}

bool NewtonLoop::direction(const PrimalPoint& point, VecX* d) {
  const BlockMatrix H = assemble_hessian(p, graph, stiffnesses(p, point.y));
  const int affordable =
      options.lag_factor ? NewtonDirection::kMaxConjugateGradients : solver.affordable_gradients();
  if (factor_is_dear()) {
    regions.resize(p.num_contacts());
    for (int i = 0; i < p.num_contacts(); ++i)
      regions[i] = contact_region(contact_law(p, i), point.y.segment<3>(3 * i));
  }
  if (factor_is_near(affordable)) {
    // As many digits as the tolerance still wants, but no more than a step between two active sets is worth.
    const double forcing =
        std::clamp(0.3 * tolerance() / residual(point), options.lag_factor ? 1e-3 : 1e-6, 0.1);
    if (solver.solve_lagged(graph.pattern, H, -point.gradient, forcing, affordable, d, &summary)) return true;
    lag_failed = true;
  }
  factored_regions = regions;
  return solver.solve_directly(graph.pattern, H, -point.gradient, d, &summary);
}

bool NewtonLoop::should_stop(const PrimalPoint& point, double best_residual, int iterations_without_gain) {
  constexpr int kPatience =
      12;  // residuals of a sound run may rise while the cost falls, but not this long at rounding
  const bool in_vain = iterations_without_gain >= kPatience || summary.iterations >= max_iterations();
  if (residual(point) <= tolerance() || (in_vain && best_residual <= options.tolerance)) {
    summary.ending = SolveEnding::converged;
    summary.message =
        fmt::format("momentum residual {:.2e} <= tolerance {:.2e} after {} iterations",
                    std::min(residual(point), best_residual), options.tolerance, summary.iterations);
    return true;
  }
  if (!std::isfinite(residual(point)) || !std::isfinite(point.cost)) {
    summary.ending = SolveEnding::failed;
    summary.message = fmt::format("the cost became {} in iteration {}", point.cost, summary.iterations);
    return true;
  }
  if (iterations_without_gain >= kPatience) {
    summary.ending = SolveEnding::stalled;
    summary.message =
        fmt::format("cost and momentum residual {:.2e} no longer fall; tolerance {:.2e} is not met",
                    best_residual, options.tolerance);
    return true;
  }
  if (summary.iterations >= max_iterations()) {
    summary.ending = SolveEnding::max_iterations;
    summary.message = fmt::format("momentum residual {:.2e} > tolerance {:.2e} after {} iterations",
                                  best_residual, options.tolerance, summary.iterations);
    return true;
  }
  return false;
}

PrimalPoint NewtonLoop::run(PrimalPoint point) {
  constexpr double kCostRounding = 4e-16;
  constexpr double kExactSlope = 1e-6;   // the next Newton step gains more than further digits here
  constexpr double kInexactSlope = 0.1;  // an inexact direction is not worth more
  constexpr double kSettled = 0.1;       // of the tolerance
  VecX best_w = point.w;
  double best = residual(point);
  int iterations_without_gain = 0;
  while (true) {
    summary.residual_history.push_back(residual(point));
    if (should_stop(point, best, iterations_without_gain)) break;

    // 1. Newton direction, or steepest descent should rounding have spoiled it
    ++summary.iterations;
    VecX d;
    if (!direction(point, &d)) {
      summary.ending = SolveEnding::failed;
      summary.message = fmt::format("the Hessian is not positive definite in double precision (iteration {})",
                                    summary.iterations);
      break;
    }
    if (!(d.dot(point.gradient) < 0.0)) d = -point.gradient;

    // 2. Step: the whole direction where the cost is level at its end
    const double level = options.lag_factor ? kInexactSlope : kExactSlope;
    PrimalPoint next = primal_point(p, point.w + d);
    if (!(std::abs(d.dot(next.gradient)) <= level * std::abs(d.dot(point.gradient)))) {
      const LineSearchResult search = exact_line_search(p, point, d, level);
      summary.line_search_evaluations += search.evaluations;
      if (search.t != 1.0) next = primal_point(p, point.w + search.t * d);
    }

    // 3. Where a factor is dear: blocks settle on their own what holds up few of them
    if (factor_is_dear() && residual(next) > options.tolerance) {
      if (!descent) descent.emplace(p);
      next = descent->descend(next, kSettled * options.tolerance / residual_scale);
    }

    // 4. Progress
    const bool cost_fell = next.cost < point.cost * (1.0 - kCostRounding);
    const bool residual_fell = residual(next) < 0.9 * best;
    iterations_without_gain = cost_fell || residual_fell ? 0 : iterations_without_gain + 1;
    point = std::move(next);
    if (residual(point) < best) {
      best = residual(point);
      best_w = point.w;
    }
  }
  return residual(point) == best ? point : primal_point(p, std::move(best_w));
}

SolveSummary failed(const std::string& message) {
  SolveSummary summary;
  summary.message = message;
  return summary;
}

}  // namespace

SolveSummary NewtonSolver::solve(const ContactProblem& problem, const SolveOptions& options,
                                 ContactSolution* solution) {
  const double start = wall_seconds();
  options.validate();
  if (const std::string defect = problem.defect(); !defect.empty()) return failed(defect);
  if (const std::string rigid = rigid_contact(problem); !rigid.empty()) return failed(rigid);

  const WhitenedProblem white = whiten(problem);
  SolveSummary summary;
  NewtonLoop loop{white.problem,
                  options,
                  contact_graph(problem),
                  1.0 / (root_mean_mass(problem) * options.reference_speed),
                  direction_,
                  summary};
  VecX w;
  if (solution->v.size() == problem.v_star.size()) {
    w = white.to_w(solution->v);
    loop.warm = true;
  } else if (problem.num_contacts() == 0) {
    w = white.problem.v_star;
  } else if (!loop.all_stick_start(&w)) {
    return failed("the Hessian of the sticking contacts is not positive definite in double precision");
  }
  const PrimalPoint point = loop.run(primal_point(white.problem, std::move(w)));
  solution->v = white.to_v(point.w);
  solution->gamma = point.gamma;
  summary.time_seconds = wall_seconds() - start;
  return summary;
}

}  // namespace cupola
