#pragma once

#include "assembly/model/accuracy.hpp"
#include "solver/analysis/statics/cyclic_symmetry.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/flow_rule.hpp"

namespace cupola {

/// Stability of an equilibrium against small disturbances.
enum class Balance {
  stable,    ///< stiffness of the joints plus geometric stiffness is positive (semi)definite
  unstable,  ///< it has a negative direction, along which no joint that closes ends the motion
  unknown    ///< not examined: rigid joints, ties, one sector only, or joints that slide under Coulomb's law
};

struct StaticCertificate {
  ForceCertificate force_error;
  ForcesUnique forces_unique;
  Balance balance = Balance::unknown;
  bool exact_forces =
      false;  ///< forces in exact equilibrium are proven to exist next to those found, under any law
};

/// What is certain about a static solution, computed from the solution alone.
///
/// **Force error.** The static problem of associated, compliant joints minimises the strictly convex energy
/// 1/2 F . c F + gap . F over the forces F in the cones that balance the loads. Let F' be such a force state
/// and d any displacement. The duality gap
///
///     G(d, F') = sum_i [ 1/2 |F'_i - F_i(d)|_c^2 + F'_i . z_i ],   z = D^T d + gap + c F(d)
///
/// bounds the distance to the exact forces F*: |F' - F*|_c <= sqrt(2 G). F' and d are one Newton correction
/// of the solution F: they carry the imbalance that remains over the loaded contacts. F' is kept inside the
/// cones, and its imbalance is computed in extended precision. Hence
///
///     F* = F + (F' - F) + rest,   |rest|_c <= sqrt(2 G) + last correction + rounding of D^T d
///
/// The resultant of a joint is in error by at most that of F' - F plus, by Cauchy's inequality, |rest|_c
/// times sqrt(sum of 1/c_i over the joint); the moment about its centroid likewise, with 1/c_i weighted by
/// the squared lever. The value is the largest such bound over the wrench of the joint (moments over the
/// square root of the joint's area), over the joints that carry more than 1 % of the mean joint force.
///
/// **Stability.** The second variation of the energy: the stiffness of the joints in their present state plus
/// the geometric stiffness of the contact forces, which act on points that rotate with their blocks. An arch
/// with an odd number of voussoirs can have a hinge on either side of its key stone, and sways until one
/// closes: open joints that the motion closes, whatever their opening, count as closed (sway_stiffness.hpp).
/// Growth slower than exp(t sqrt(1e-3 g / m)) is not reported.
///
/// **Existence.** Any law, rigid joints too: exact_equilibrium.hpp.
///
/// `loads`: N, N m (6 nb). `gravity`: m/s2, sets that smallest growth rate. `problem` and `solution` are
/// those of the whole model; with a symmetry the linear algebra is done on one sector.
StaticCertificate certify_static(const ContactSet& contacts, const VecX& loads, const ContactProblem& problem,
                                 const ContactSolution& solution, const FlowRule& law, double gravity,
                                 const CyclicSymmetry* symmetry = nullptr);

}  // namespace cupola
