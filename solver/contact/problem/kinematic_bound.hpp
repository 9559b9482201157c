#pragma once

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Lower bound (N) of the sum of the normal forces in any equilibrium of the loads, from the velocities v of
/// a mechanism. It holds for every compliance of the joints and can prove that a structure cannot stand.
///
/// By virtual power, impulses in the cones that balance the loads M v_star satisfy
///
///     v . M v_star  =  - sum_i gamma_i . u_i  <=  sum_i gamma_n,i delta_i,
///     u = D^T v,    delta = (mu |u_t| - u_n)+
///
/// so their normal components sum to at least (v . M v_star) / max delta. The result is
///
/// Joints with strength can in addition dissipate up to
///
///     sum_i  c |u_t| + T (u_n - mu |u_t|)+,
///
/// and no more than F delta where their compression F is finite. The other contacts then supply the rest of
/// the work. Where there are none that approach and the dissipation cannot reach the work, there is no
/// equilibrium.
///
///     infinity    if v opens every joint or slides along it (u in Y*) while the loads do work:
///                 the kinematic theorem of limit analysis, or the dissipation cannot
///                 reach the work;
///     0           if the loads do no work;
///     a value below the sum of the actual normal forces, for every v, if the structure stands.
///
/// Requires a problem at rest: v_star = h M^-1 f.
double required_normal_force(const ContactProblem& problem, const VecX& v);

/// Sum of the normal forces gamma_n / h, N.
double normal_force_sum(const ContactProblem& problem, const VecX& gamma);

}  // namespace cupola
