#pragma once

#include <vector>

#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// Lays facets of different blocks that face each other within `distance` (m) and 1e-2 rad in one plane each:
/// the mean of theirs, weighted by area. Every vertex moves to the point nearest to it that fulfils the
/// planes of its facets (least squares). Returns the number of facets moved.
int snap_facets(std::vector<TriangleMesh>* blocks, double facet_angle, double distance);

}  // namespace cupola
