#pragma once

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Why a structure cannot stand, from the velocities v of its mechanism: the least sum of normal forces (N)
/// that any equilibrium of its loads would need, whatever the joints' compliance. By virtual power, impulses
/// in the cones that balance the loads M v_star satisfy
///
///     v . M v_star = - sum_i gamma_i . u_i  <=  sum_i gamma_n,i delta_i,   u = D^T v,  delta = (mu |u_t| -
///     u_n)+
///
/// so that their normal parts sum to at least v . M v_star / max delta. Velocities that open or slide along
/// every joint (u in Y*) while the loads do work give infinity: the kinematic theorem of limit analysis. Of a
/// structure that stands the bound stays below the sum of its normal forces, for every v. 0 when the loads do
/// no work. Needs a problem at rest: v_star = h M^-1 f.
double required_normal_force(const ContactProblem& problem, const VecX& v);

/// Sum of the normal forces gamma_n / h, N.
double normal_force_sum(const ContactProblem& problem, const VecX& gamma);

}  // namespace cupola
