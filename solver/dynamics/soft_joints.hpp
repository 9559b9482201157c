#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// A warning if the compliance of the joints lets the model sink by more than 1 % of its height under its own
/// weight and the loads: the displacements then move the thrust, and are no longer small. The sinking is
/// estimated: the joints on supports share the load like parallel springs, and the load grows in proportion
/// to the depth below the top.
std::vector<std::string> soft_joints(const Case& scene, const Assembly& assembly, const ContactSet& contacts);

}  // namespace cupola
