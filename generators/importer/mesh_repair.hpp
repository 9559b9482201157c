#pragma once

#include <span>

#include "generators/decomposition/triangle_mesh.hpp"
#include "generators/importer/block_mesh.hpp"

namespace cupola {

/// The closed, outward triangle surface of a block as read: vertices nearer than `weld` x block size become
/// one, faces without area are dropped, polygons are split into triangles (a fan from the first vertex, which
/// decides what a warped face means), faces that disagree are turned.
/// Throws InputError naming block and file when what is left is open, inside out as a whole, or crosses
/// itself (exact predicates).
TriangleMesh repair_mesh(const RawBlock& block, double weld);

/// Convex hull of the points; throws InputError naming the block when they lie in one plane.
TriangleMesh hull_mesh(const RawBlock& block, std::span<const Vec3> points);

}  // namespace cupola
