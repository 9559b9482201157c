#include "solver/conic/solve_conic.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/process.hpp"
#include "solver/conic/embedding.hpp"
#include "solver/conic/scaled_problem.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {
namespace {

/// How the iteration ends at an iterate; none: it goes on.
std::optional<ConicOutcome> outcome_at(const Embedding& x, const EmbeddingResiduals& r, double tolerance) {
  const double primal = r.primal / x.tau(), dual = r.dual_value / x.tau();
  const double size = std::max({1.0, std::abs(primal), std::abs(dual)});
  if (r.primal_error <= tolerance && r.dual_error <= tolerance && std::abs(primal - dual) <= tolerance * size)
    return ConicOutcome::optimal;
  if (r.dual_value > 0.0 && r.mechanism_error <= tolerance * r.dual_value) return ConicOutcome::infeasible;
  if (r.primal < 0.0 && r.ray_error <= -tolerance * r.primal) return ConicOutcome::unbounded;
  if (!std::isfinite(primal + dual)) return ConicOutcome::stalled;
  return std::nullopt;
}

ConicOutcome iterate(const ConicOptions& options, Embedding* x, int* iterations) {
  constexpr double kToBoundary = 0.99, kSmallestStep = 1e-6;
  while (true) {
    throw_if_interrupted();
    const EmbeddingResiduals r = x->residuals();
    if (const auto outcome = outcome_at(*x, r, options.tolerance)) return *outcome;
    if (*iterations >= options.max_iterations || !x->factorize()) return ConicOutcome::stalled;
    ++*iterations;
    const EmbeddingStep predicted = x->predictor(r);
    const double remaining =
        x->complementarity_after(predicted, std::min(1.0, predicted.length)) / x->complementarity();
    const double sigma = std::pow(std::clamp(remaining, 0.0, 1.0), 3);
    const EmbeddingStep step = x->corrector(r, sigma, predicted);
    const double length = std::min(1.0, kToBoundary * step.length);
    if (!(length > kSmallestStep)) return ConicOutcome::stalled;
    x->take(step, length);
  }
}

}  // namespace

ConicSolution solve_conic(const ConicProblem& problem, const ConicOptions& options) {
  const double started = wall_seconds();
  const ScaledConicProblem s = scaled(problem);
  ConicSolution solution;
  Embedding x(s.problem);
  solution.outcome = iterate(options, &x, &solution.iterations);
  if (solution.outcome == ConicOutcome::optimal) x.balance_forces();
  // Certificates have no natural length; they are scaled so that their proof is of the size of the problem.
  const double length =
      solution.outcome == ConicOutcome::infeasible || solution.outcome == ConicOutcome::unbounded
          ? 1.0
          : 1.0 / x.tau();
  solution.gamma = s.force * length * x.gamma();
  solution.multipliers = length * s.multiplier.cwiseProduct(x.t());
  solution.v = s.unknown * s.objective / s.force * length * s.white.to_v(x.v());
  solution.row_velocities = s.objective * length * x.q().cwiseQuotient(s.row);
  solution.primal = problem.cost.dot(solution.gamma) + problem.multiplier_cost.dot(solution.multipliers);
  solution.dual = problem.load.dot(solution.v) + problem.row_values.dot(solution.row_velocities);
  solution.seconds = wall_seconds() - started;
  return solution;
}

}  // namespace cupola
