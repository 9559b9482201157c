#pragma once

#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Duality gap of (v, gamma in Y), J, computed without subtracting two large objectives:
///
///     1/2 r^T M^-1 r + sum_i [ 1/2 |gamma - gamma(v)|_E^2 + gamma . z ],  r = M (v - v_star) - D gamma,
///                                                                         z = D^T v + b + E gamma(v) in Y*
double duality_gap(const ContactProblem& problem, const ContactSolution& solution);

/// Term of one contact in the sum, >= 0, at y = D^T v + b. Requires a compliant contact.
double contact_duality_gap(const ContactLaw& law, const Vec3& y, const Vec3& gamma);

/// |gamma|_E = sqrt(gamma^T E gamma), sqrt(J): the norm of the compliance.
double compliance_norm(const ContactProblem& problem, const VecX& gamma);

/// Upper bound of |gamma - exact|_E, sqrt(J): the dual objective is strongly convex in the norm of N + E, so
/// that |gamma - exact|_E <= sqrt(2 gap). Includes running bounds of the rounding errors of r and y and of an
/// impulse that lies outside its cone. Holds for the associated law and all E > 0. By Cauchy's inequality the
/// sum of the impulses of a joint, in any one direction, errs by at most sqrt(sum 1 / E_i) times this bound.
double force_error_bound(const ContactProblem& problem, const ContactSolution& solution);

}  // namespace cupola
