#pragma once

#include "assembly/case/analysis.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Chooses `thresholds.displacement` unless the case gives it: half the mean size of the free blocks, the cube
/// root of their volume, at most 0.5 m, so that models which differ in scale only have the same status.
void resolve_thresholds(const Assembly& assembly, Analysis::Thresholds* thresholds);

}  // namespace cupola
