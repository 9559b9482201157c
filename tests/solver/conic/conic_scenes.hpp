#pragma once

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/solve_conic.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::scenes {

/// The rigid blocks of a contact problem under their weights, without an objective.
inline ConicProblem conic(const ContactProblem& p) {
  ConicProblem problem;
  problem.contacts = p;
  problem.load = VecX::Zero(6 * p.num_blocks());
  for (int k = 0; k < p.num_blocks(); ++k)
    problem.load.segment<6>(6 * k) = p.M[k] * p.v_star.segment<6>(6 * k) / p.h;
  problem.cost = VecX::Zero(3 * p.num_contacts());
  problem.load_columns = MatX(problem.load.size(), 0);
  problem.rows = MatX(problem.cost.size(), 0);
  return problem;
}

/// Adds a multiplier of a load, which is to be as large as possible.
inline void maximise_load(ConicProblem* problem, const VecX& load) {
  problem->load_columns = load;
  problem->multiplier_cost = VecX::Constant(1, -1.0);
  problem->row_multipliers = MatX(1, 0);
}

/// Horizontal load along x, of the size of the weights.
inline VecX sideways(const ConicProblem& problem) {
  VecX load = VecX::Zero(problem.load.size());
  for (Eigen::Index k = 0; k < load.size(); k += 6) load[k] = -problem.load[k + 2];
  return load;
}

/// Least and largest value of the objective; both certified to 1e-9.
inline std::pair<double, double> range(ConicProblem problem) {
  double ends[2];
  for (double& end : ends) {
    const double sign = &end == ends ? 1.0 : -1.0;
    problem.cost *= sign;
    const ConicSolution solution = solve_conic(problem);
    EXPECT_EQ(solution.outcome, ConicOutcome::optimal) << solution.iterations;
    const ConicBounds bounds = conic_bounds(problem, solution);
    EXPECT_LE(bounds.imbalance, 1e-11);  // rounding of the forces, magnified by the arch's slenderness
    EXPECT_LE(bounds.cone_violation, 1e-12);
    EXPECT_LE(bounds.lower, bounds.upper + 1e-9 * std::abs(bounds.upper));
    EXPECT_NEAR(bounds.lower, bounds.upper, 1e-6 * std::max(1.0, std::abs(bounds.upper)));
    end = sign * solution.primal;
    problem.cost *= sign;
  }
  return {ends[0], ends[1]};
}

}  // namespace cupola::scenes
