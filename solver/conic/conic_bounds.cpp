#include "solver/conic/conic_bounds.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cupola {
namespace {

/// Force and moment of each block, whitened by its mass so that they compare: |L^-1 x|^2 = x . M^-1 x.
double largest_block(const ContactProblem& p, const VecX& x) {
  double largest = 0.0;
  for (int k = 0; k < p.num_blocks(); ++k) {
    const Eigen::Vector<double, 6> block = x.segment<6>(6 * k);
    largest = std::max(largest, block.dot(p.M[k].ldlt().solve(block)));
  }
  return std::sqrt(largest);
}

}  // namespace

double ConicBounds::relative_gap() const {
  const double size = std::max(std::abs(upper), std::abs(lower));
  return size > 0.0 ? std::abs(upper - lower) / size : 0.0;
}

ConicBounds conic_bounds(const ConicProblem& problem, const ConicSolution& x) {
  const ContactProblem& p = problem.contacts;
  const VecX imbalance =
      generalized_impulse(p, x.gamma) + problem.load_columns * x.multipliers + problem.load;
  const VecX missing_rows = problem.row_values - problem.rows.transpose() * x.gamma -
                            problem.row_multipliers.transpose() * x.multipliers;
  ConicBounds bounds;
  double largest_load = largest_block(p, problem.load);
  for (Eigen::Index j = 0; j < problem.load_columns.cols(); ++j)
    largest_load =
        std::max(largest_load, largest_block(p, problem.load_columns.col(j)) * std::abs(x.multipliers[j]));
  if (largest_load > 0.0) bounds.imbalance = largest_block(p, imbalance) / largest_load;

  const VecX s = problem.cost + relative_velocity(p, x.v) - problem.rows * x.row_velocities;
  double largest_force = 0.0, outside = 0.0, gain = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const auto gamma = x.gamma.segment<3>(3 * i);
    largest_force = std::max(largest_force, gamma[0]);
    outside = std::max({outside, gamma.tail<2>().norm() - p.mu[i] * gamma[0], -gamma[0]});
    gain += std::max(0.0, (p.mu[i] > 0.0 ? p.mu[i] * s.segment<2>(3 * i + 1).norm() : 0.0) - s[3 * i]);
  }
  if (largest_force > 0.0) bounds.cone_violation = outside / largest_force;
  gain *= largest_force;
  const VecX power = problem.multiplier_cost + problem.load_columns.transpose() * x.v -
                     problem.row_multipliers * x.row_velocities;
  gain += power.cwiseAbs().dot(x.multipliers.cwiseAbs());
  bounds.lower = problem.load.dot(x.v) + problem.row_values.dot(x.row_velocities) - kLargestForces * gain;
  bounds.upper = problem.cost.dot(x.gamma) + problem.multiplier_cost.dot(x.multipliers) + x.v.dot(imbalance) +
                 x.row_velocities.dot(missing_rows);
  return bounds;
}

}  // namespace cupola
