#pragma once

#include <string>
#include <vector>

#include "generators/stereotomy/shell.hpp"

namespace cupola {

// Where the members of a case stand. `key` of a member is for messages; all throw InputError for places that
// contradict each other.

/// From the coordinates of a member to those in which its place is given.
Eigen::Isometry3d placement_at(const Place& place);
/// m, z of the level beds of springers in the coordinates of a groin vault, whose springing is at 0.
double level_of_springers(const Storey& vault);
/// Puts a member on the one below it, whose last bed must be as level as its own first. Two kinds stand on
/// several and begin a stack of their own: a groin vault, by default on the axis about which the `bearer` has
/// `copies`, and an arch with a place of its own, or whose plane of symmetry is that of the `mirror` of the
/// bearer. `bearer`: the first member of the stack below.
void stand_on(const std::string& key, const Member& bearer, const Member& member, const Storey& lower,
              Storey* storey);
/// Puts a member beside one of those before it, and ends its supports at their common plane. Its placement on
/// entry counts from the other member.
void stand_beside(const Beside& beside, const std::string& key, const std::vector<Storey>& storeys,
                  Storey* storey);
/// Ends the supports of members also at the planes up to which others stand beside them.
void limit_neighbours(std::vector<Storey>* storeys);
/// Appends the copies of the stack that begins with storey `first`, or its mirror image; `member`: that of
/// its first storey.
void copy_stack(const Member& member, size_t first, std::vector<Storey>* storeys);

}  // namespace cupola
