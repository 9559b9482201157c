#pragma once

#include <string>
#include <vector>

#include "generators/decomposition/convex_polyhedron.hpp"
#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

struct DecompositionOptions {
  double facet_angle =
      1e-6;            ///< rad: triangles within this angle form a facet; edges reflex by less are flat
  double flat = 1e-6;  ///< times the block size: distance from a facet's plane that counts as zero
};

/// Convex parts of one block.
struct Decomposition {
  enum class Method { already_convex, planes, prism, nef };
  Method method = Method::already_convex;
  std::vector<ConvexPolyhedron> parts;
  /// Per part and face: true if the face lies between two parts and contains none of the block's surface.
  std::vector<std::vector<bool>> internal;
  double volume = 0.0;        ///< m3, of the block
  double volume_error = 0.0;  ///< m3, sum over the parts minus the block
};

/// Splits a block into convex parts that form a partition: their volumes add up to that of the block within
/// 1e-9 of it, or within the unevenness of its facets times their area if that is more.
///
/// A convex block remains one part, whose faces are its facets. Otherwise the methods are tried in this order
/// until one gives a partition: plane voting, unless the prism partition needs fewer parts; prism partition;
/// CGAL's Nef polyhedra. Throws InputError with `name` if none does.
Decomposition decompose(const TriangleMesh& mesh, const std::string& name,
                        const DecompositionOptions& options = {});

/// CGAL's exact decomposition. It is correct for any closed block, but slow, and it splits along coplanar
/// edges that rounding makes reflex. Empty if CGAL fails.
std::vector<ConvexPolyhedron> decompose_by_nef(const TriangleMesh& mesh);

}  // namespace cupola
