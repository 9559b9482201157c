#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A convex face of one convex part of a block.
struct PartFace {
  int part = 0;
  std::vector<Vec3> corners;  ///< m, counter-clockwise seen from outside the part
};

/// The faces of the union of the parts: what two faces cover from opposite sides is removed, and corners of
/// other faces that lie on an edge become corners of its faces, so that every edge joins two faces.
/// Tolerances are relative to the size of the block.
std::vector<std::vector<Vec3>> union_faces(const std::vector<PartFace>& faces);

}  // namespace cupola
