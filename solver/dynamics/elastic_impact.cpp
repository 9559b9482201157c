#include "solver/dynamics/elastic_impact.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cupola {
namespace {

/// 1/kg, N_nn: velocity along the normal that one impulse along it gives.
double normal_mobility(const ContactProblem& problem, int i) {
  const auto of = [&](int block, const Lever& D) {
    if (block < 0) return 0.0;
    const Vec6 n = D.matrix().col(0);
    return n.dot(problem.M[block].llt().solve(n));
  };
  return of(problem.block_a[i], problem.D_a[i]) + of(problem.block_b[i], problem.D_b[i]);
}

}  // namespace

double elastic_impact(const StepStart& start, const StepProblem& step, const ContactSolution& solution,
                      double acceleration, const StepOptions& options) {
  const ContactProblem& problem = step.problem;
  double longest = 0.0;
  for (int i = 0; i < step.num_contacts; ++i) {
    const Vec3 imposed = step.support_velocity_of(i);
    const bool closes = solution.gamma[3 * i] > 0.0 && start.elastic_gap[i] >= 0.0;
    if (!closes || problem.E[3 * i] == 0.0) continue;
    const double c = problem.E[3 * i] * step.impulse_time[i] * options.damped_reach();
    const double time = std::sqrt(c / normal_mobility(problem, i));
    const double approach = -relative_velocity(problem, i, start.state.v)[0] - imposed[0];
    if (time > std::max(options.h, options.damping) && approach > acceleration * time)
      longest = std::max(longest, time);
  }
  return longest;
}

}  // namespace cupola
