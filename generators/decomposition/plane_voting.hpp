#pragma once

#include <vector>

#include "generators/decomposition/convex_polyhedron.hpp"
#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// Cuts a closed polyhedron into convex parts by planes through its reflex edges.
///
/// A box around the block is split by planes into cells until no reflex edge passes through a cell. The
/// pieces of the solid inside such a cell are convex; each is the cell clipped by the facets in it.
///
/// The candidates for the next plane are planes through two coplanar reflex edges, extensions of the two
/// facets at a reflex edge, and bisectors. The candidate with the highest score is chosen:
///     + 1    for each reflex edge in the plane that has less than 180 deg of solid on either side of it,
///     + 0.2  for each of those edges whose facet the plane extends, at most 0.4,
///     - 0.5  if the plane lies within 11 deg of a facet at such an edge without extending it (slivers),
///     - 1    for each limb of the block that the plane cuts after the first.
///
/// Returns no parts if more than `most_parts` would be needed.
std::vector<ConvexPolyhedron> decompose_by_planes(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                                  const std::vector<ReflexEdge>& reflex_edges,
                                                  int most_parts);

}  // namespace cupola
