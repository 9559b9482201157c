#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/base/error.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Polygons on a vertex list, as a file gives them.
struct PolygonMesh {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;  ///< vertex ids, counter-clockwise seen from outside when oriented
};

/// One block as read, before anything is checked.
struct RawBlock {
  std::string name;    ///< as the file calls it
  FileLocation where;  ///< where it begins
  PolygonMesh mesh;
  /// Convex parts as point clouds, in the formats that give those instead of faces.
  std::vector<std::vector<Vec3>> point_parts;
  bool fixed = false;
  std::optional<double> density;  ///< kg/m3, where the file says
};

/// Polygon in which two blocks of the file touch, in the file's units and axes.
struct RawInterface {
  FileLocation where;
  std::string block_a, block_b;
  std::vector<Vec3> points;
};

/// Tie between two blocks of the same file set, by block names.
struct RawTie {
  FileLocation where;
  std::string block_a, block_b;
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();
  double stiffness = 0.0;  ///< N/m; infinity for a rod
  double length = 0.0;     ///< m, at rest
  bool pushes = false;     ///< carries compression too
};

}  // namespace cupola
