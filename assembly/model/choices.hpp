#pragma once

#include "assembly/base/named_enum.hpp"

namespace cupola {

enum class AnalysisType { static_, dynamic, staged, limit, range, path };
constexpr auto enum_names(AnalysisType) {
  return std::array{"static", "dynamic", "staged", "limit", "range", "path"};
}

/// Methods for the frictional contact problem of one step; solver/contact/methods describes each.
enum class ContactMethod { newton, interior_point, spg, apgd, nsgs, admm };
constexpr auto enum_names(ContactMethod) {
  return std::array{"newton", "interior_point", "spg", "apgd", "nsgs", "admm"};
}

/// `associated`: the convex problem of the paper, in which sliding opens the contact by mu |u_t|.
/// `coulomb`: sliding does not open the contact. `dilatant`: between the two, by a given ratio of dilatancy.
enum class FrictionLaw { associated, coulomb, dilatant };
constexpr auto enum_names(FrictionLaw) {
  return std::array{"associated", "coulomb", "dilatant"};
}

/// Time integration of motions. `euler`: implicit, first order, the paper's. `generalized_alpha`: second
/// order while contacts stay closed.
enum class TimeIntegrator { euler, generalized_alpha };
constexpr auto enum_names(TimeIntegrator) {
  return std::array{"euler", "generalized_alpha"};
}

/// Tangential contact force of a dynamic analysis. `memory`: a spring that remembers its elastic slip.
/// `literal`: the paper's scheme, which has no memory and creeps.
enum class TangentialSpring { memory, literal };
constexpr auto enum_names(TangentialSpring) {
  return std::array{"memory", "literal"};
}

/// What the recovery speed of a dynamic analysis limits. `compliant`: the recovery of penetration beyond that
/// due to the compliance. `literal`: all of it (paper eq. 14, 15), and with it the force of a compliant
/// contact.
enum class Recovery { compliant, literal };
constexpr auto enum_names(Recovery) {
  return std::array{"compliant", "literal"};
}

}  // namespace cupola
