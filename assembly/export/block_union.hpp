#pragma once

#include <vector>

#include "assembly/model/polygon_parts.hpp"

namespace cupola {

/// The faces of the union of convex parts of a block, all faces of which are given: what two faces cover from
/// opposite sides is removed, and corners of other faces that lie on an edge become corners of its faces, so
/// that every edge joins two faces. Tolerances are relative to the size of the block.
std::vector<std::vector<Vec3>> union_faces(const std::vector<PlanePolygon>& faces);

}  // namespace cupola
