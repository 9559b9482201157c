#pragma once

#include <span>

#include "generators/decomposition/triangle_mesh.hpp"
#include "generators/importer/block_mesh.hpp"

namespace cupola {

/// The closed, outward oriented triangle surface of a block. Vertices nearer than `weld` times the block size
/// are merged, faces without area and repetitions of a face are dropped (`doubled`, which may be null,
/// receives how many repetitions), triangles as flat as that go to the face across their longest side, faces
/// with inconsistent orientation are reversed, and polygons are split into triangles (triangulate_polygon),
/// which defines the shape of a warped face. Throws InputError with block and file if the result is open,
/// inside out or intersects itself (exact predicates).
TriangleMesh repair_mesh(const RawBlock& block, double weld, int* doubled = nullptr);

/// Convex hull of the points. Throws InputError with the block if they lie in one plane.
TriangleMesh hull_mesh(const RawBlock& block, std::span<const Vec3> points);

}  // namespace cupola
