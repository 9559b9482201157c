#include "solver/conic/solve_conic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "assembly/base/process.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/dry_problem.hpp"
#include "solver/conic/embedding.hpp"
#include "solver/conic/scaled_problem.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {
namespace {

double relative_gap(const Embedding& x, const EmbeddingResiduals& r) {
  const double primal = r.primal / x.tau(), dual = r.dual_value / x.tau();
  return std::abs(primal - dual) / std::max({1.0, std::abs(primal), std::abs(dual)});
}

double error_of(const Embedding& x, const EmbeddingResiduals& r) {
  return std::max({r.primal_error, r.dual_error, relative_gap(x, r)});
}

/// The certificate that an iterate gives, if any.
std::optional<ConicOutcome> certificate(const EmbeddingResiduals& r, double tolerance) {
  if (r.dual_value > 0.0 && r.mechanism_error <= tolerance * r.dual_value) return ConicOutcome::infeasible;
  if (r.primal < 0.0 && r.ray_error <= -tolerance * r.primal) return ConicOutcome::unbounded;
  return std::nullopt;
}

/// One predictor-corrector step. False if rounding leaves no step.
bool advance(const EmbeddingResiduals& r, Embedding* x) {
  constexpr double kToBoundary = 0.99, kSmallestStep = 1e-6;
  if (!x->factorize()) return false;
  const EmbeddingStep predicted = x->predictor(r);
  const double remaining =
      x->complementarity_after(predicted, std::min(1.0, predicted.length)) / x->complementarity();
  const double sigma = std::pow(std::clamp(remaining, 0.0, 1.0), 3);
  const EmbeddingStep step = x->corrector(r, sigma, predicted);
  const double length = std::min(1.0, kToBoundary * step.length);
  if (!(length > kSmallestStep)) return false;
  x->take(step, length);
  return true;
}

/// Iterates until an end is certain, or until rounding stops the progress; then returns to the best iterate.
/// `dual`: the iterate whose mechanism promises the best bound by conic_bounds(). Its residuals go on falling
/// after rounding has stopped those of the forces.
ConicOutcome iterate(const ConicOptions& options, int num_contacts, Embedding* x, Embedding::Point* dual,
                     int* iterations) {
  constexpr int kPatience = 3;  // iterations without a lower error once the solution is good enough
  double least = std::numeric_limits<double>::infinity();
  Embedding::Point best = x->point();
  int since_best = 0;
  double highest = -std::numeric_limits<double>::infinity();
  double enough = options.target;
  while (true) {
    throw_if_interrupted();
    const EmbeddingResiduals r = x->residuals();
    if (const auto end = certificate(r, options.tolerance)) return *end;
    const double error = error_of(*x, r);
    const double bound = r.dual_value / x->tau() - kLargestForces * num_contacts * r.dual_error;
    if (bound > highest) {
      highest = bound;
      *dual = x->point();
    }
    ++since_best;
    if (error < least) {
      least = error;
      best = x->point();
      since_best = 0;
    }
    enough = std::max(options.target, options.relative_target * std::min(1.0, std::abs(r.primal) / x->tau()));
    if (least <= enough || (least <= options.tolerance && since_best >= kPatience)) break;
    if (!std::isfinite(error) || *iterations >= options.max_iterations) break;
    ++*iterations;
    if (!advance(r, x)) break;
  }
  x->move_to(best);
  return least <= std::max(options.tolerance, enough) ? ConicOutcome::optimal : ConicOutcome::stalled;
}

ConicSolution solve_dry(const ConicProblem& problem, const ConicOptions& options) {
  const ScaledConicProblem s = scaled(problem);
  ConicSolution solution;
  Embedding x(s);
  Embedding::Point mechanism;
  solution.outcome = iterate(options, problem.contacts.num_contacts(), &x, &mechanism, &solution.iterations);
  // Certificates have no natural length.
  const bool proof =
      solution.outcome == ConicOutcome::infeasible || solution.outcome == ConicOutcome::unbounded;
  if (proof) mechanism = x.point();
  if (!proof) x.balance_forces();
  const double length = proof ? 1.0 : 1.0 / x.tau(), dual_length = proof ? 1.0 : 1.0 / mechanism.tau;
  solution.gamma = s.force * length * x.gamma();
  solution.multipliers = length * s.multiplier.cwiseProduct(x.t());
  solution.v = s.objective / s.force * dual_length * s.white.to_v(mechanism.v);
  solution.row_velocities = s.objective * dual_length * mechanism.q.cwiseQuotient(s.row);
  return solution;
}

}  // namespace

ConicSolution solve_conic(const ConicProblem& problem, const ConicOptions& options) {
  const double started = wall_seconds();
  check_sizes(problem);
  ConicSolution solution;
  if (problem.has_strength()) {
    for (const auto limits : {DryProblem::Limits::near_loads, DryProblem::Limits::all}) {
      const DryProblem dry(problem, limits);
      solution = dry.original(solve_dry(dry.problem(), options));
      if (dry.solves(solution)) break;
    }
  } else {
    solution = solve_dry(problem, options);
  }
  solution.primal = problem.cost.dot(solution.gamma) + problem.multiplier_cost.dot(solution.multipliers);
  solution.dual = dual_value(problem, solution);
  solution.seconds = wall_seconds() - started;
  return solution;
}

}  // namespace cupola
