#pragma once

#include <vector>

#include "tests/extremes/extreme_scene.hpp"

namespace cupola {

void add_static_rows(std::vector<ExtremeScene>* rows);
void add_dynamic_rows(std::vector<ExtremeScene>* rows);
void add_refused_rows(std::vector<ExtremeScene>* rows);

/// A free block, 1 m wide at the bottom, between two fixed blocks whose joints lean outward by `lean_deg`
/// from the vertical.
Assembly wedge(double lean_deg);

}  // namespace cupola
