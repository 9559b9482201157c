#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves a contact problem of any compliance, zero included, under Coulomb's law by proximal points, each
/// found by a semismooth Newton method in the velocities:
///
///     M (v - v_star) = D gamma,   gamma = Gamma(D^T v + b - R gamma_k),   v, gamma -> v, gamma_k+1
///
/// Gamma is Coulomb's explicit law for the compliance E + R (coulomb_impulse, cone.hpp), so that an answer
/// that repeats itself solves the given problem, whatever R >= 0. R is a share of each contact's own Delassus
/// block; it grows tenfold where Newton fails and shrinks where it succeeds. The Jacobian is unsymmetric: one
/// sparse LU of 6 nb unknowns per iteration, several times the cost of a convex solve's Cholesky. Hence the
/// last resort where the convex passes of outer_iterations.hpp, De Saxce's fixed point, run in circles.
///
/// The measure is that of the passes: worst of the residuals over what can be asked of it.
SolveSummary solve_coulomb_newton(const ContactProblem& problem, const SolveOptions& options,
                                  ContactSolution* solution);

}  // namespace cupola
