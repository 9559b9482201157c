#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Primal-dual interior point method for the associated law, all E >= 0, on the whitened problem with the
/// slack z = J^T w + b + E gamma in Y*. With the Nesterov-Todd scaling W (W gamma = W^-1 z = lambda) and
/// Mehrotra's predictor and corrector, each iteration solves
///
///     (I + J G J^T) dw = -r_d + J G (W d - r_p),   G = (W^2 + E)^-1,
///     d = lambda \ (sigma mu_c e - lambda o lambda - affine correction)
///
/// with the same Cholesky pattern as Newton. The cone of a frictionless contact is the half-line. Andersen,
/// Dahl, Vandenberghe (2013), "The CVXOPT linear and quadratic cone program solvers", sections 4-5.
///
/// Used to start Newton: the number of iterations hardly depends on how many contacts open and close.
/// Converged when the mean complementarity gamma . z of the contacts is <= `tolerance` times their mean
/// elastic work gamma . E gamma (at E = 0: times the mean |gamma| reference_speed). Below about 1e-8 the
/// scaling breaks down, and the ending is `stalled`. Default of max_iterations: 80.
SolveSummary solve_interior_point(const ContactProblem& problem, const SolveOptions& options,
                                  ContactSolution* solution);

}  // namespace cupola
