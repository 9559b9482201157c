#pragma once

#include "assembly/case/case.hpp"

namespace cupola {

/// Adds the laws of fresh and curing mortar while course `ring` is being laid. Joints above that course are
/// as young as its own.
void add_fresh_joints(const StagedConstruction& staged, int ring, Joints* joints);

/// Sets the property of fresh mortar that analysis.staged.least names.
void set_fresh(double value, StagedConstruction* staged);

}  // namespace cupola
