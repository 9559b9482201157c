#pragma once

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Primal-dual interior point for the associated law, all E >= 0, on the whitened problem with the slack
/// z = J^T w + b + E gamma in Y*. Each iteration solves, with Nesterov-Todd scaling W (W gamma = W^-1 z =
/// lambda) and Mehrotra's predictor and corrector,
///
///     (I + J G J^T) dw = -r_d + J G (W d - r_p),   G = (W^2 + E)^-1,
///     d = lambda \ (sigma mu_c e - lambda o lambda - affine correction)
///
/// on the same Cholesky pattern as Newton. Frictionless contacts have the half-line for a cone.
/// Andersen, Dahl, Vandenberghe (2013), "The CVXOPT linear and quadratic cone program solvers", sections 4-5.
///
/// It is meant to bring Newton near: what it needs hardly depends on how many contacts open and close. It
/// stops as `converged` when the contacts' mean complementarity gamma . z falls below `tolerance` times their
/// mean elastic work gamma . E gamma (at E = 0: times the mean |gamma| reference_speed) and the momentum
/// residual below `tolerance`; beyond about 1e-8 the scaling breaks down and the ending is `stalled`.
SolveSummary solve_interior_point(const ContactProblem& problem, const SolveOptions& options,
                                  ContactSolution* solution);

}  // namespace cupola
