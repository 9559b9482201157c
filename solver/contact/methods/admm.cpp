#include "solver/contact/methods/admm.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/iteration_log.hpp"

namespace cupola {

namespace {

struct AlternatingDirections {
  const WhitenedProblem& white;
  const ContactProblem& p = white.given;
  ContactGraph graph;
  BlockCholesky factor;
  VecX base;  ///< E + 1e-4 trace N_ii / 3 (3 nc): R = rho / base
  double rho = 1.0;
  VecX w, y, gamma, z;

  explicit AlternatingDirections(const WhitenedProblem& problem);
  bool factorize();
  void iterate();
  /// sqrt(primal residual / dual residual), both in units of impulse; > 1 requires a larger rho.
  double imbalance = 1.0;
};

AlternatingDirections::AlternatingDirections(const WhitenedProblem& problem)
    : white(problem), graph(contact_graph(p)), base(p.E) {
  constexpr double kShare = 1e-4;
  const VecX traces = delassus_traces(p);
  for (int i = 0; i < p.num_contacts(); ++i) base.segment<3>(3 * i).array() += kShare * traces[i] / 3.0;
}

bool AlternatingDirections::factorize() {
  std::vector<Mat3> R(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i)
    R[i] = (rho / base.segment<3>(3 * i).array()).matrix().asDiagonal();
  return factor.factorize(graph.pattern, assemble_hessian(white, graph, R));
}

void AlternatingDirections::iterate() {
  constexpr double kOverRelaxation = 1.6;
  const VecX R = rho * base.cwiseInverse();
  w = factor.solve(white.w_star + generalized_impulse(white, gamma + R.cwiseProduct(z - p.b)));
  y = relative_velocity(white, w) + p.b;
  const VecX relaxed = kOverRelaxation * y + (1.0 - kOverRelaxation) * z;
  const VecX shifted = relaxed - gamma.cwiseQuotient(R);
  VecX next(gamma.size());
  for (int i = 0; i < p.num_contacts(); ++i) {
    const ContactLaw law =
        contact_law(p, i, p.E[3 * i] + 1.0 / R[3 * i], p.E[3 * i + 1] + 1.0 / R[3 * i + 1]);
    next.segment<3>(3 * i) = contact_impulse(law, shifted.segment<3>(3 * i));
  }
  const VecX z_next = relaxed + (next - gamma).cwiseQuotient(R);
  const double primal = R.cwiseProduct(y - z_next).norm(), dual = R.cwiseProduct(z_next - z).norm();
  imbalance = std::sqrt(primal / std::max(dual, std::numeric_limits<double>::min()));
  gamma = next;
  z = z_next;
}

}  // namespace

SolveSummary solve_admm(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution) {
  constexpr int kIterationsPerCheck = 5;
  constexpr int kIterationsPerBalance = 20;
  constexpr double kImbalance = 3.0;  // smaller corrections of rho are not worth a factorisation
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const int max_iterations = options.max_iterations.value_or(2000);

  const WhitenedProblem white = whiten(problem);
  AlternatingDirections admm(white);
  const bool warm = solution->gamma.size() == problem.b.size() && solution->v.size() == problem.v_star.size();
  admm.gamma = warm ? solution->gamma : VecX::Zero(problem.b.size());
  admm.w = warm ? white.to_w(solution->v) : white.w_star;
  admm.z = warm ? VecX(relative_velocity(white, admm.w) + problem.b) : problem.b;

  double best = std::numeric_limits<double>::infinity();
  bool valid = admm.factorize();
  ++summary.factorizations;
  while (valid && best > options.tolerance && summary.iterations < max_iterations) {
    throw_if_interrupted();
    report_iteration("admm", summary.iterations, best, options.tolerance);
    admm.iterate();
    ++summary.iterations;
    if (summary.iterations % kIterationsPerCheck == 0 || summary.iterations == max_iterations) {
      const ContactSolution x{white.to_v(admm.w), admm.gamma};
      const double now = largest_residual(compute_residuals(problem, x, options.reference_speed));
      summary.residual_history.push_back(now);
      if (now < best) {
        best = now;
        *solution = x;
      }
    }
    const bool unbalanced = admm.imbalance > kImbalance || admm.imbalance < 1.0 / kImbalance;
    if (summary.iterations % kIterationsPerBalance == 0 && unbalanced && best > options.tolerance) {
      admm.rho *= std::clamp(admm.imbalance, 0.1, 10.0);
      valid = admm.factorize();
      ++summary.factorizations;
    }
  }
  if (!valid || !std::isfinite(best)) {
    summary.message =
        fmt::format("the penalised mass matrix is not positive definite in double precision (iteration {})",
                    summary.iterations);
    return summary;
  }
  const bool converged = best <= options.tolerance;
  summary.ending = converged ? SolveEnding::converged : SolveEnding::max_iterations;
  summary.measure = ErrorMeasure::all_residuals;
  summary.reached = best;
  summary.message =
      fmt::format("largest residual {:.2e} {} tolerance {:.2e} after {}", best, converged ? "<=" : ">",
                  options.tolerance, counted(summary.iterations, "iteration"));
  return summary;
}

}  // namespace cupola
