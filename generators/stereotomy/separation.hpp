#pragma once

#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A convex part, prepared for separating-axis tests.
struct ConvexShape {
  std::vector<Vec3> vertices;         ///< m, without duplicates
  std::vector<Plane> planes;          ///< of the faces, outward
  std::vector<int> faces;             ///< face ids of the assembly, in the order of `planes`
  std::vector<Vec3> edge_directions;  ///< unit vectors, one per set of parallel edges
};
ConvexShape convex_shape(const Assembly& assembly, const Part& part);

/// Depth (m) by which two convex shapes overlap, <= 0 if they are apart: the smallest overlap of their
/// projections on the separating axes (face normals of both, then cross products of edges). Returns at the
/// first axis with an overlap of at most `good_enough`.
double overlap_depth(const ConvexShape& a, const ConvexShape& b, double good_enough);

/// Least shift (m) that separates two convex polygons in one plane, over the directions normal to their
/// edges; <= 0 if they are apart.
double overlap_width(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& normal);

/// Least width (m) of what two convex polygons in one plane have in common, as contact detection measures a
/// joint; 0 if nothing. For a strip inside a wide face it is that of the strip.
double common_width(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

}  // namespace cupola
