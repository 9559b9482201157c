#include "solver/conic/conic_bounds.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "solver/contact/problem/cone.hpp"

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

/// What the joints dissipate in a motion.
struct Dissipation {
  double constant = 0.0;  ///< J/s: by the strengths that no multiplier changes
  VecX per_multiplier;    ///< by those that each multiplier adds (nt)
};

/// Joints that never crush count as if they did at `most` (N), and none crushes at more. 0: they count
/// nothing.
Dissipation dissipation(const ConicProblem& problem, const ConicSolution& x, double most) {
  const ContactProblem& p = problem.contacts;
  const VecX s = problem.cost + relative_velocity(p, x.v) - problem.rows * x.row_velocities;
  Dissipation sum;
  sum.per_multiplier = VecX::Zero(problem.load_columns.cols());
  for (int i = 0; i < p.num_contacts(); ++i) {
    const double mu = p.mu[i];
    const ContactStrength whole = strength_at(problem, i, VecX::Ones(sum.per_multiplier.size()));
    const double slip = mu > 0.0 || whole.cohesion > 0.0 ? s.segment<2>(3 * i + 1).norm() : 0.0;
    const double opening = s[3 * i] - mu * slip;
    const auto power = [&](const ContactStrength& strength, double compression) {
      return ContactLaw{.mu = mu, .strength = strength}.dissipation(slip, opening) +
             compression * std::max(0.0, -opening);
    };
    const ContactStrength own = p.strength.empty() ? ContactStrength{} : p.strength[i];
    const bool crushes = std::isfinite(whole.compression);
    sum.constant += power(own, !crushes || (most > 0.0 && own.compression > most) ? most : own.compression);
    for (size_t j = 0; j < problem.strength_columns.size(); ++j) {
      const ContactStrength& column = problem.strength_columns[j][i];
      sum.per_multiplier[static_cast<Eigen::Index>(j)] += power(column, crushes ? column.compression : 0.0);
    }
  }
  return sum;
}

/// The least value of all states whose forces are at most `times` the largest of x, and multipliers as many
/// times its own: the dual value less what the violations of its conditions could gain.
double least_value(const ConicProblem& problem, const ConicSolution& x, double largest_force, double times) {
  const Dissipation lost = dissipation(problem, x, times * largest_force);
  const VecX power = problem.multiplier_cost + problem.load_columns.transpose() * x.v -
                     problem.row_multipliers * x.row_velocities - lost.per_multiplier;
  return problem.load.dot(x.v) + problem.row_values.dot(x.row_velocities) - lost.constant -
         times * power.cwiseAbs().dot(x.multipliers.cwiseAbs());
}

/// N: of a block.
double largest_force_of(const VecX& load) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < load.size(); k += 6) largest = std::max(largest, load.segment<3>(k).norm());
  return largest;
}

double largest_normal_force(const VecX& gamma) {
  return gamma(Eigen::seq(0, Eigen::last, 3)).cwiseAbs().maxCoeff();
}

}  // namespace

double positive_up_to(const ConicProblem& problem, const ConicSolution& x) {
  constexpr double kMost = 1e12;
  const double force = largest_normal_force(x.gamma);
  const auto is_positive = [&](double times) { return least_value(problem, x, force, times) > 0.0; };
  if (!is_positive(1.0)) return 0.0;
  if (is_positive(kMost)) return kMost;
  double low = 1.0, high = kMost;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (is_positive(middle) ? low : high) = middle;
  }
  return low;
}

double dual_value(const ConicProblem& problem, const ConicSolution& x) {
  return problem.load.dot(x.v) + problem.row_values.dot(x.row_velocities) -
         dissipation(problem, x, 0.0).constant;
}

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

  double largest_force = 0.0, outside = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Vec3 gamma = x.gamma.segment<3>(3 * i);
    ContactLaw law = contact_law(p, i);
    law.strength = strength_at(problem, i, x.multipliers);
    largest_force = std::max(largest_force, std::abs(gamma[0]));
    outside = std::max(outside, limit_excess(law, gamma));
  }
  if (largest_force > 0.0) bounds.cone_violation = outside / largest_force;
  // Forces that vanish where they could bear the loads must not bound those of other states.
  double scale = std::max(largest_force, largest_force_of(problem.load));
  for (Eigen::Index j = 0; j < problem.load_columns.cols(); ++j)
    scale = std::max(scale, largest_force_of(problem.load_columns.col(j)) * std::abs(x.multipliers[j]));
  bounds.lower = least_value(problem, x, scale, kLargestForces);
  bounds.upper = problem.cost.dot(x.gamma) + problem.multiplier_cost.dot(x.multipliers) + x.v.dot(imbalance) +
                 x.row_velocities.dot(missing_rows);
  return bounds;
}

}  // namespace cupola
