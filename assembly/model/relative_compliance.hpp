#pragma once

#include "assembly/model/assembly.hpp"
#include "assembly/model/joint_laws.hpp"

namespace cupola {

/// Finds the compliances per area of `joints.compliance.relative`: a joint closes by that share of the size
/// of a block, the cube root of its volume, under the weight of a block on the square of its size. That is
/// `relative` over the mean weight per volume of the free blocks (m3/N), so that models which differ in scale
/// only deform alike. `gravity` in m/s2; without gravity 9.81. No effect on compliances that the case gives.
void resolve_compliance(const Assembly& assembly, const Vec3& gravity, Compliance* compliance);

}  // namespace cupola
