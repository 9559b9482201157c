#pragma once

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Region of the friction cone that a contact is in. At mu = 0 a closed contact counts as slipping.
enum class ContactRegion { stick, slip, separation };

/// Compliance, friction and flow rule of one contact.
struct ContactLaw {
  double e_n = 0.0;        ///< 1/kg, > 0
  double e_t = 0.0;        ///< 1/kg, > 0; unused at mu = 0
  double mu = 0.0;         ///< >= 0
  double dilatancy = 1.0;  ///< ratio to friction, in [0, 1]; see flow_rule.hpp
};
inline ContactLaw contact_law(const ContactProblem& problem, int i) {
  return {problem.E[3 * i], problem.E[3 * i + 1], problem.mu[i]};
}

/// True if some compliance that the law uses is zero. A frictionless contact uses no tangential one.
inline bool is_rigid(const ContactLaw& law) {
  return law.e_n == 0.0 || (law.mu > 0.0 && law.e_t == 0.0);
}

/// Impulse of a compliant contact at the relative velocity y = D^T v + b (m/s, normal first): the gamma in
/// the cone Y (|gamma_t| <= mu gamma_n) whose plastic velocity z = y + E gamma is zero in stick, has no
/// impulse in separation, and obeys the flow rule z_n = theta mu |z_t|, z_t opposite to gamma_t, in slip (theta:
/// dilatancy). The three regions are
///
///     separation  y_n >= theta mu |y_t|            gamma = 0
///     stick       |y_t| / e_t <= mu (-y_n) / e_n   gamma = -E^-1 y
///     slip        otherwise                        gamma = a (1, -mu y_t / |y_t|),
///                                                  a = (-y_n + theta mu |y_t|) / (e_n + theta mu^2 e_t)
///
/// At theta = 1 this is the projection of -E^-1 y on Y in the norm of E, and z lies in Y* and is perpendicular to
/// gamma. At theta = 0 the normal impulse is (-y_n)+ / e_n.
///
/// Castro, Permenter, Han (2022), "An unconstrained convex formulation of compliant contact", section on
/// regularised friction. Our sign of y differs: y_n > 0 opens the contact.
Vec3 contact_impulse(const ContactLaw& law, const Vec3& y);
ContactRegion contact_region(const ContactLaw& law, const Vec3& y);

/// G = -d gamma / d y, kg: an element of the generalised Jacobian, symmetric positive semidefinite at
/// theta = 1 and unsymmetric below. On the boundary of stick it is the derivative of the stick side, on the
/// boundary of separation that of the open side.
Mat3 contact_stiffness(const ContactLaw& law, const Vec3& y);

/// Projection of x on Y in the norm of diag(e_n, e_t, e_t): argmin over Y of (g - x)^T E (g - x).
Vec3 project_on_cone(const ContactLaw& metric, const Vec3& x);

}  // namespace cupola
