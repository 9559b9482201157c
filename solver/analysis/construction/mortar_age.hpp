#pragma once

#include "assembly/case/case.hpp"

namespace cupola {

/// The laws of fresh and curing mortar, by course, while course `ring` is being laid. Joints above that course
/// are as young as its own.
std::vector<RingJoints> mortar_by_course(const StagedConstruction& staged, int ring);

/// True if mortar on which so many courses were laid has not hardened.
bool is_fresh(const StagedConstruction& staged, int courses);

/// Sets the property of fresh mortar that analysis.staged.least names.
void set_fresh(double value, StagedConstruction* staged);

}  // namespace cupola
