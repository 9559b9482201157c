#include "solver/contact/methods/spg.hpp"

#include <algorithm>
#include <deque>

#include "solver/contact/methods/dual_problem.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/iteration_log.hpp"

namespace cupola {

namespace {

constexpr double kArmijo = 1e-4;                       // sufficient decrease, as in the cited algorithm
constexpr int kMemory = 10;                            // recent objectives in the non-monotone line search
constexpr double kAlphaMin = 1e-10, kAlphaMax = 1e10;  // in units of the preconditioner: 1 is a Jacobi step

/// Step length along d from objective f with slope gd and curvature dAd, such that the objective stays below
/// the largest of the recent ones.
double nonmonotone_step(double f, double gd, double dAd, const std::deque<double>& recent) {
  const double ceiling = *std::max_element(recent.begin(), recent.end());
  double lambda = 1.0;
  for (int k = 0; k < 50; ++k) {
    if (f + lambda * gd + 0.5 * lambda * lambda * dAd <= ceiling + kArmijo * lambda * gd) break;
    const double minimiser = -gd / dAd;  // of the quadratic, exact
    lambda = std::clamp(minimiser, 0.1 * lambda, 0.5 * lambda);
  }
  return lambda;
}

}  // namespace

SolveSummary solve_spg(const ContactProblem& problem, const SolveOptions& options,
                       ContactSolution* solution) {
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const int max_iterations = options.max_iterations.value_or(5000);

  const DualProblem dual = make_dual_problem(problem);
  VecX gamma = first_impulses(dual, *solution);
  VecX g = dual.times(gamma) + dual.q;
  double f = 0.5 * gamma.dot(g + dual.q);
  std::deque<double> recent{f};
  double alpha = 1.0;
  VecX best = gamma;
  double best_f = f, best_accuracy = dual_accuracy(dual, gamma, g);
  summary.residual_history.push_back(best_accuracy);
  bool stalled = false;
  while (best_accuracy > options.tolerance && summary.iterations < max_iterations && !stalled) {
    throw_if_interrupted();
    report_iteration("spg", summary.iterations, best_accuracy, options.tolerance);
    ++summary.iterations;
    const VecX d = dual.project(gamma - alpha * g.cwiseQuotient(dual.B)) - gamma;
    const VecX Ad = dual.times(d);
    const double gd = g.dot(d), dAd = d.dot(Ad);
    stalled = !(gd < 0.0);
    const double lambda = nonmonotone_step(f, gd, dAd, recent);
    gamma += lambda * d;
    g += lambda * Ad;
    if (summary.iterations % 50 == 0) g = dual.times(gamma) + dual.q;  // removes the rounding of the updates
    f = 0.5 * gamma.dot(g + dual.q);
    recent.push_back(f);
    if (std::ssize(recent) > kMemory) recent.pop_front();
    alpha = dAd > 0.0 ? std::clamp(d.dot(dual.B.cwiseProduct(d)) / dAd, kAlphaMin, kAlphaMax) : kAlphaMax;

    const double accuracy = dual_accuracy(dual, gamma, g);
    summary.residual_history.push_back(accuracy);
    if (f < best_f || accuracy <= options.tolerance) {
      best_f = f;
      best_accuracy = accuracy;
      best = gamma;
    }
  }
  *solution = {dual.velocities(best), best};
  finish_dual(dual, best_accuracy, options, stalled, &summary);
  return summary;
}

}  // namespace cupola
