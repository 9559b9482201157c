#pragma once

#include <vector>

#include "generators/decomposition/decompose.hpp"

namespace cupola {

/// Gives facets of different blocks that face each other a common plane, the mean of theirs weighted by area,
/// if all their corners lie within `distance` (m) of it. Then moves every corner to the nearest point on the
/// planes of its facets. Returns the number of facets in common planes. Facets are found with the tolerances
/// of `options`.
int snap_facets(std::vector<TriangleMesh>* blocks, const DecompositionOptions& options, double distance);

}  // namespace cupola
