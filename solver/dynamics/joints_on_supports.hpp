#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Warnings about the joints on supports under the largest weight and loads within the analysis, but for loads
/// that its limit multiplies:
/// - Their compliance lets the model sink by more than 1 % of its height: the displacements then move the
///   thrust, and are no longer small. The sinking is estimated: these joints share the load like parallel
///   springs, and the load grows in proportion to the depth below the top. `rigid`: the analysis knows no
///   compliance.
/// - They cannot carry the loads at their compressive strength, even evenly.
/// And about all joints of blocks that touch at edges or corners only, whose forces no strength limits, and
/// about laws of rings that no joint has.
std::vector<std::string> joint_warnings(const Case& scene, const Assembly& assembly,
                                        const ContactSet& contacts, bool rigid);

}  // namespace cupola
