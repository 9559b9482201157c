#pragma once

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Multiplies density, mass and inertia of each free block by the mean of a random function of place over the
/// block, by its values at the centroids of tetrahedra. Nothing if the density does not vary.
void vary_density(const Imperfections& imperfections, Assembly* assembly);

}  // namespace cupola
