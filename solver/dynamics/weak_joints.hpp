#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// A warning if the joints on supports cannot carry the loads at their compressive strength, even evenly.
std::vector<std::string> weak_joints(const Case& scene, const Assembly& assembly, const ContactSet& contacts);

}  // namespace cupola
