#pragma once

#include <vector>

#include "assembly/model/applied_loads.hpp"

namespace cupola {

/// Appends lantern and top load, shared by area among the top faces that carry them, at the face centroids:
/// their weights and, at PointForce::kSteady, their pull. Of several members a lantern stands on the domes and
/// a top load on the walls, where there are any. Throws InputError if these have no top face, or if the tops
/// of domes differ: a lantern stands on one.
void add_loads_on_top(const Loads& loads, const Assembly& assembly, std::vector<PointForce>* forces);

/// Throws InputError if nothing can carry the lantern that a limit analysis seeks. `gravity`: m/s2.
void require_top_for_lantern(const Assembly& assembly, double gravity);

}  // namespace cupola
