#pragma once

#include "solver/conic/conic_problem.hpp"

namespace cupola {

/// What a solution proves, computed from the matrices of the problem alone.
struct ConicBounds {
  /// The least value is at most this: c . gamma + e . t plus the work v . (D gamma + P t + w) of the forces
  /// that equilibrium still lacks, and the product of q and what the further conditions lack.
  double upper = 0.0;
  /// Over all states whose multipliers are at most kLargestForces times those of the solution, and whose forces
  /// as many times the largest of its forces and loads, the value is at least this: the dual value less what
  /// the violations of its conditions could gain.
  double lower = 0.0;
  double imbalance = 0.0;       ///< largest |D gamma + P t + w| of a block over the largest load of a block
  double cone_violation = 0.0;  ///< largest excess of a force over its limits, over the largest gamma_n
  double relative_gap() const;  ///< |upper - lower| over the larger of their sizes
};
constexpr double kLargestForces = 1e3;

/// Bounds on the least value from a solution that is `optimal` or `stalled`.
ConicBounds conic_bounds(const ConicProblem& problem, const ConicSolution& solution);

/// The largest N, within 1 %, for which every state with forces and multipliers of at most N times those of
/// the solution has a value above zero: 0 if there is none, at most 1e12.
double positive_up_to(const ConicProblem& problem, const ConicSolution& solution);

/// The value of the dual problem, as far as its conditions hold: w . v + r . q less what joints with strength
/// dissipate.
double dual_value(const ConicProblem& problem, const ConicSolution& solution);

}  // namespace cupola
