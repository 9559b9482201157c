#include "solver/contact/methods/apgd.hpp"

#include <cmath>
#include <utility>

#include "solver/contact/methods/dual_problem.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/iteration_log.hpp"

namespace cupola {

SolveSummary solve_apgd(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution) {
  constexpr double kRelaxation = 0.9, kGrowth = 2.0;
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const int max_iterations = options.max_iterations.value_or(5000);

  const DualProblem dual = make_dual_problem(problem);
  VecX gamma = first_impulses(dual, *solution);
  VecX A_gamma = dual.times(gamma);  // (N + E) gamma, updated with gamma so that A x costs no product
  VecX x = gamma, A_x = A_gamma;
  double L = 1.0, theta = 1.0;
  VecX best = gamma;
  double best_accuracy = dual_accuracy(dual, gamma, A_gamma + dual.q);
  summary.residual_history.push_back(best_accuracy);
  bool stalled = false;
  while (best_accuracy > options.tolerance && summary.iterations < max_iterations && !stalled) {
    throw_if_interrupted();
    report_iteration("apgd", summary.iterations, best_accuracy, options.tolerance);
    ++summary.iterations;

    // 1. Projected step from x; L is raised until it majorises f along the step
    const VecX g = A_x + dual.q;
    VecX next, A_next;
    while (true) {
      next = dual.project(x - g.cwiseQuotient(L * dual.B));
      A_next = dual.times(next);
      const VecX step = next - x;
      if (step.dot(A_next - A_x) <= L * step.dot(dual.B.cwiseProduct(step)) * (1.0 + 1e-12)) break;
      L *= kGrowth;
    }

    // 2. Momentum, dropped where it points uphill
    const double theta_next = 0.5 * (std::sqrt(std::pow(theta, 4) + 4.0 * theta * theta) - theta * theta);
    double beta = theta * (1.0 - theta) / (theta * theta + theta_next);
    theta = theta_next;
    if (dual.B.cwiseProduct(x - next).dot(next - gamma) > 0.0) {
      theta = 1.0;
      beta = 0.0;
    }
    stalled = next == gamma && beta == 0.0;
    x = next + beta * (next - gamma);
    A_x = A_next + beta * (A_next - A_gamma);
    gamma = std::move(next);
    A_gamma = std::move(A_next);
    L *= kRelaxation;

    // 3. Accuracy
    const double accuracy = dual_accuracy(dual, gamma, A_gamma + dual.q);
    summary.residual_history.push_back(accuracy);
    if (accuracy < best_accuracy) {
      best_accuracy = accuracy;
      best = gamma;
    }
  }
  *solution = {dual.velocities(best), best};
  finish_dual(dual, best_accuracy, options, stalled, &summary);
  return summary;
}

}  // namespace cupola
