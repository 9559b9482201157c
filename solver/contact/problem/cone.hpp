#pragma once

#include <algorithm>
#include <optional>

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Region of the set of admissible impulses that a contact is in. A frictionless closed contact without
/// cohesion counts as slipping.
enum class ContactRegion {
  stick,          ///< inside
  slip,           ///< shear at its limit
  separation,     ///< no impulse
  yield,          ///< normal impulse at the limit of tension or compression
  yield_and_slip  ///< both
};

/// Compliance, friction, flow rule and strength of one contact.
struct ContactLaw {
  double e_n = 0.0;        ///< 1/kg, > 0
  double e_t = 0.0;        ///< 1/kg, > 0; unused without friction and cohesion
  double mu = 0.0;         ///< >= 0
  double dilatancy = 1.0;  ///< ratio to friction, in [0, 1]; see flow_rule.hpp
  ContactStrength strength = {};

  bool carries_shear() const { return mu > 0.0 || strength.cohesion > 0.0; }
  /// Largest shear impulse at the normal impulse n, N s.
  double shear_limit(double n) const { return strength.cohesion + mu * n; }
  /// Largest pull, N s. Friction ends it where no shear can be carried any more.
  double tension_limit() const {
    return mu > 0.0 ? std::min(strength.tension, strength.cohesion / mu) : strength.tension;
  }
  /// The most that cohesion and tension dissipate in the relative velocity s, by the slip |s_t| (0 without
  /// shear) and the opening beyond dilatancy s_n - mu |s_t|: with compression * max(0, -opening), the largest
  /// -gamma . s of all gamma in Y.
  double dissipation(double slip, double opening) const {
    return strength.cohesion * slip + tension_limit() * std::max(0.0, opening);
  }
};
inline ContactLaw contact_law(const ContactProblem& problem, int i) {
  ContactLaw law{problem.E[3 * i], problem.E[3 * i + 1], problem.mu[i]};
  if (!problem.strength.empty()) law.strength = problem.strength[i];
  return law;
}
/// The law of a contact with other compliances, as the metric of a projection or with a proximal term.
inline ContactLaw contact_law(const ContactProblem& problem, int i, double e_n, double e_t) {
  ContactLaw law = contact_law(problem, i);
  law.e_n = e_n;
  law.e_t = e_t;
  return law;
}

/// True if some compliance that the law uses is zero.
inline bool is_rigid(const ContactLaw& law) {
  return law.e_n == 0.0 || (law.carries_shear() && law.e_t == 0.0);
}

/// The first contact of the problem with zero compliance, if there is one.
std::optional<int> first_rigid_contact(const ContactProblem& problem);

/// Impulse of a compliant contact at the relative velocity y = D^T v + b (m/s, normal first): the gamma in
/// the set Y (contact_problem.hpp) whose plastic velocity z = y + E gamma is zero in stick and obeys the flow
/// rule elsewhere. For dry joints these are three regions (theta: dilatancy):
///
///     separation  y_n >= theta mu |y_t|            gamma = 0
///     stick       |y_t| / e_t <= mu (-y_n) / e_n   gamma = -E^-1 y
///     slip        otherwise                        gamma = a (1, -mu y_t / |y_t|),
///                                                  a = (-y_n + theta mu |y_t|) / (e_n + theta mu^2 e_t)
///
/// With cohesion c, tension T and compression F the stick impulse is -E^-1 y with its normal component
/// limited to [-T, F], as long as its shear does not exceed c + mu gamma_n; otherwise the contact slips at
///
///     gamma_n = (-y_n + theta mu (|y_t| - e_t c)) / (e_n + theta mu^2 e_t), limited to [-T, F],
///     gamma_t = -(c + mu gamma_n) y_t / |y_t|
///
/// At theta = 1 this is the projection of -E^-1 y on Y in the norm of E, and -z is an outward normal of Y at
/// gamma. At theta = 0 the normal impulse is -y_n / e_n, limited to [-T, F].
///
/// Castro, Permenter, Han (2022), "An unconstrained convex formulation of compliant contact", section on
/// regularised friction, without strength. Our sign of y differs: y_n > 0 opens the contact.
Vec3 contact_impulse(const ContactLaw& law, const Vec3& y);
ContactRegion contact_region(const ContactLaw& law, const Vec3& y);

/// G = -d gamma / d y, kg: an element of the generalised Jacobian, symmetric positive semidefinite at
/// theta = 1 and unsymmetric below. On the boundary of stick it is the derivative of the stick side, on the
/// boundary of separation that of the open side.
Mat3 contact_stiffness(const ContactLaw& law, const Vec3& y);
/// Impulse at y, and dy^T G dy: what a line search along dy needs, in one evaluation.
struct ContactResponse {
  Vec3 impulse;
  double curvature;
};
ContactResponse contact_response(const ContactLaw& law, const Vec3& y, const Vec3& dy);
/// The stiffness in stick.
Mat3 sticking_stiffness(const ContactLaw& law);

/// Projection of x on Y in the norm of diag(e_n, e_t, e_t): argmin over Y of (g - x)^T E (g - x).
Vec3 project_on_admissible(const ContactLaw& metric, const Vec3& x);

/// Largest excess of a component of gamma over its limit, N s; 0 inside Y.
double limit_excess(const ContactLaw& law, const Vec3& gamma);

}  // namespace cupola
