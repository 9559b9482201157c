#pragma once

#include "solver/conic/conic_problem.hpp"

namespace cupola {

/// Solves a conic problem by a primal-dual interior-point method on the homogeneous self-dual embedding of
/// Xu, Hung and Ye (1996), as Andersen, Roos and Terlaky (2003), "On implementing a primal-dual
/// interior-point method for conic quadratic optimization", extend it to cones: with tau, kappa >= 0,
///
///     D gamma + P t + w tau = 0,           Q^T gamma + R^T t = r tau,
///     s = c tau + D^T v - Q q,             e tau + P^T v - R q = 0,
///     kappa = w . v + r . q - c . gamma - e . t
///
/// always has a solution. One with tau > 0 is the solution of the problem, one with kappa > 0 proves that
/// there is none: w . v + r . q > 0 that no forces satisfy the conditions, c . gamma + e . t < 0 that the
/// objective has no minimum. Nesterov-Todd scaling and Mehrotra's predictor and corrector as in the contact
/// method `interior_point`. Free multipliers and further conditions are a dense border of the sparse matrix.
///
/// The error of an iterate is the largest of its equilibrium residual, its dual residual and its gap (over
/// the larger of 1 and the objective), in scaled units: forces over the largest load of a block, the
/// objective over its largest coefficient. Redundant contacts and dependent equilibrium rows are admitted.
/// Joints with strength are cones with limits (dry_problem.hpp), which the normal equations absorb
/// (normal_limits.hpp). Throws std::invalid_argument for sizes that do not match, and Interrupted.
ConicSolution solve_conic(const ConicProblem& problem, const ConicOptions& options = {});

}  // namespace cupola
