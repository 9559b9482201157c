#pragma once

#include <string>

namespace cupola {

/// Methods for the frictional contact problem of a step; what each is: solver/contact/.
enum class ContactMethod { newton, interior_point, spg, apgd, nsgs, admm };

/// `associated`: the convex problem of the paper, in which sliding opens the contact by mu |u_t|.
/// `coulomb`: De Saxce's change of variable, sliding without opening.
enum class FrictionLaw { associated, coulomb };

std::string to_string(ContactMethod method);
std::string to_string(FrictionLaw law);

}  // namespace cupola
