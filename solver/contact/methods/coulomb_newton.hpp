#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves a contact problem of any compliance, zero included, under Coulomb's law by the proximal point
/// method. Each subproblem is solved by a semismooth Newton method in the velocities:
///
///     M (v - v_star) = D gamma,   gamma = Gamma(D^T v + b - R gamma_k),   v, gamma -> v, gamma_k+1
///
/// Gamma is Coulomb's explicit law for the compliance E + R (coulomb_impulse in cone.hpp). A fixed point
/// solves the given problem for any R >= 0. R is a share of the Delassus block of each contact: it grows
/// tenfold where Newton fails and shrinks where it succeeds. The Jacobian is unsymmetric. Each iteration
/// costs a sparse LU of 6 nb unknowns, several times the cost of the Cholesky factor of a convex solve. Used
/// therefore only where the outer iterations (outer_iterations.hpp, De Saxce's fixed point) stall.
///
/// Converged when excess() of the residuals is <= 1, as for the outer iterations.
SolveSummary solve_coulomb_newton(const ContactProblem& problem, const SolveOptions& options,
                                  ContactSolution* solution);

}  // namespace cupola
