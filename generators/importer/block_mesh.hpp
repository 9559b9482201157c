#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/base/error.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Polygons on a list of vertices, as read from a file.
struct PolygonMesh {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>>
      faces;  ///< vertex ids; counter-clockwise seen from outside if oriented correctly
};

/// One block as read from a file, before any check.
struct RawBlock {
  std::string name;    ///< in the file
  FileLocation where;  ///< of its first line
  PolygonMesh mesh;
  /// Convex parts as point clouds, for formats without faces.
  std::vector<std::vector<Vec3>> point_parts;
  bool fixed = false;
  std::optional<double> density;   ///< kg/m3, if the file gives it
  std::optional<int> course = {};  ///< its number, if the file gives it
};

/// Polygon where two blocks of a file touch, in the units and axes of the file.
struct RawInterface {
  FileLocation where;
  std::string block_a, block_b;
  std::vector<Vec3> points;
};

/// Tie between two named blocks, in the units and axes of the file.
struct RawTie {
  FileLocation where;
  std::string block_a, block_b;
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();
  double stiffness = 0.0;  ///< N/m; infinite for a rod
  double length = 0.0;     ///< at rest
  bool pushes = false;     ///< also carries compression
};

}  // namespace cupola
