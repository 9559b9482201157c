#pragma once

#include <vector>

#include "generators/decomposition/convex_polyhedron.hpp"
#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// Cuts a block that is a prism, i.e. has two parallel caps and all other facets across them within `angle`
/// (rad), into prisms over convex pieces of its cross-section: as few as cuts from corner to corner allow
/// (Greene 1983; above 150 corners at most four times as many, Hertel and Mehlhorn 1983). No new corners
/// arise, so parts close exactly and a curve of many short chords makes no slivers.
///
/// The cross-section is the mean of the two caps, its corners those where the side facet changes. Returns
/// nothing for a block that is no such prism, or whose caps have holes.
std::vector<ConvexPolyhedron> partition_prism(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                              const std::vector<int>& facet_of, double angle);

}  // namespace cupola
