#pragma once

#include <string>
#include <vector>

#include "generators/decomposition/convex_polyhedron.hpp"
#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

struct DecompositionOptions {
  double facet_angle = 1e-6;  ///< rad: triangles within this are one facet; edges reflex by less are flat
  double flat = 1e-6;         ///< x block size: distance from a facet's plane that counts as in it
};

/// Convex parts of one block.
struct Decomposition {
  enum class Method { already_convex, planes, prism, nef };
  Method method = Method::already_convex;
  std::vector<ConvexPolyhedron> parts;
  /// Per part and face: lies between two parts of the block, with no surface of the block in it.
  std::vector<std::vector<bool>> internal;
  double volume = 0.0;        ///< m3, of the block
  double volume_error = 0.0;  ///< m3, sum of the parts less the block
};

/// Splits a block into convex parts that are a partition of it: their volumes sum to the block's within
/// 1e-9 of it, or within what the unevenness of its facets explains. A convex block stays as it is, its
/// facets bounded by its own vertices. Tries plane voting and, for prisms, their cross-section, and takes
/// what has fewer parts; then CGAL's Nef polyhedra. Throws InputError with `name` when none gives a
/// partition.
Decomposition decompose(const TriangleMesh& mesh, const std::string& name,
                        const DecompositionOptions& options = {});

/// CGAL's exact decomposition: correct for any closed block, but slow, and it splits along coplanar edges
/// that rounding turns reflex.
std::vector<ConvexPolyhedron> decompose_by_nef(const TriangleMesh& mesh);

}  // namespace cupola
