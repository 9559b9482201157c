#pragma once

#include <vector>

#include "generators/decomposition/convex_polyhedron.hpp"
#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// Cuts a closed polyhedron into convex parts by planes through its reflex edges.
///
/// A box around the block is split by planes until no reflex edge passes through a cell; the solid inside
/// such a cell is convex, piece by piece, and its parts are the cell clipped by the facets in it. The next
/// plane is the one with most votes among: planes through two coplanar reflex edges, the facets at a reflex
/// edge continued, and bisectors. A reflex edge votes for a plane that holds it and leaves less than 180 deg
/// of solid on either side. A plane gains a fifth of a vote when it continues a facet at its edges,
/// loses half when it comes within 11 deg of one without continuing it (slivers), and one for every limb of
/// the block that it cuts besides the first.
///
/// Returns nothing when more than `most_parts` parts would be needed.
std::vector<ConvexPolyhedron> decompose_by_planes(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                                  const std::vector<ReflexEdge>& reflex_edges,
                                                  int most_parts);

}  // namespace cupola
