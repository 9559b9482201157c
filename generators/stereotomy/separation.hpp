#pragma once

#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A convex part made ready for tests of separation.
struct ConvexShape {
  std::vector<Vec3> vertices;         ///< m, each once
  std::vector<Plane> planes;          ///< of the faces, outward
  std::vector<int> faces;             ///< face ids of the assembly, in the order of `planes`
  std::vector<Vec3> edge_directions;  ///< unit, parallel ones once
};
ConvexShape convex_shape(const Assembly& assembly, const Part& part);

/// Depth (m) by which two convex shapes overlap: the smallest over the separating axes (face normals of
/// both, then cross products of edges) of the overlap of their projections; <= 0 when apart.
/// Stops at the first axis with an overlap of at most `good_enough`.
double overlap_depth(const ConvexShape& a, const ConvexShape& b, double good_enough);

/// Do two convex polygons in one plane share more than a strip of the given width (m)?
bool polygons_overlap(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& normal, double width);

}  // namespace cupola
