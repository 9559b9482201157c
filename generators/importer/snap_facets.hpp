#pragma once

#include <vector>

#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// Moves facets of different blocks that face each other within `distance` (m) and 1e-2 rad to one common
/// plane, the mean of their planes weighted by area. Every vertex of such a facet moves to the nearest point
/// on the planes of its facets (least squares). Returns the number of facets moved.
int snap_facets(std::vector<TriangleMesh>* blocks, double facet_angle, double distance);

}  // namespace cupola
