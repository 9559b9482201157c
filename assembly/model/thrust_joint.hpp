#pragma once

#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// The block on which the stack of a sheet pushes outwards by a joint with this centroid (m) and unit normal
/// of either sign: a support, or a block of an earlier stack that carries its first course, of an arch at
/// x < 0 in its own frame its last. -1 for other joints, also where the heads of two members meet in an
/// upright mitre, or a wall stands on that course. The sum of these forces on that block along
/// Assembly::outward is the thrust, in tables as in ranges.
int bearer_of_thrust(const Assembly& assembly, const Sheet& sheet, const Joint& joint, const Vec3& centroid,
                     const Vec3& normal);

}  // namespace cupola
