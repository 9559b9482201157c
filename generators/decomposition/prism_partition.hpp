#pragma once

#include <vector>

#include "generators/decomposition/convex_polyhedron.hpp"
#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// Cuts a prism into prisms over convex pieces of its cross-section. A prism has two parallel caps, and all
/// its other facets are perpendicular to them within `angle` (rad).
///
/// The number of pieces is the minimum for cuts from corner to corner (Greene 1983); above 150 corners it is
/// at most four times the minimum (Hertel and Mehlhorn 1983). No corners are added, so the parts fit together
/// exactly and a curve of many short chords gives no slivers.
///
/// The cross-section is the mean of the two caps. Its corners are the points where the side facet changes.
/// Returns no parts if the block is not such a prism or its caps have holes.
std::vector<ConvexPolyhedron> partition_prism(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                              const std::vector<int>& facet_of, double angle);

}  // namespace cupola
