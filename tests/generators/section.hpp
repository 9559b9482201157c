#pragma once

#include <algorithm>
#include <cmath>
#include <set>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// True if the part has corners above and below the level z (m).
inline bool reaches_level(const Assembly& assembly, const Part& part, double z) {
  double low = INFINITY, high = -INFINITY;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    for (int v : assembly.face(f)) {
      low = std::min(low, assembly.vertices[v].z());
      high = std::max(high, assembly.vertices[v].z());
    }
  return low < z && z < high;
}

/// Blocks, without supports, whose parts contain more than `shortest` (m) of the half-line from the z axis
/// outwards at height z (m) and the given azimuth (rad). The face planes of each convex part clip the line.
inline std::set<int> blocks_on_radial_line(const Assembly& assembly, double z, double azimuth,
                                           double shortest) {
  const Vec3 origin(0.0, 0.0, z), direction(std::cos(azimuth), std::sin(azimuth), 0.0);
  std::set<int> blocks;
  for (const Part& part : assembly.parts) {
    if (part.ring < 0 || !reaches_level(assembly, part, z)) continue;
    double from = 0.0, to = INFINITY;
    for (int f = part.face_start; f < part.face_start + part.num_faces && from < to; ++f) {
      const Plane plane = polygon_plane(face_points(assembly, f));
      const double rate = plane.normal.dot(direction);
      const double height = plane.normal.dot(origin) - plane.offset;
      if (std::abs(rate) < 1e-12)
        to = height > 0.0 ? from : to;
      else if (rate > 0.0)
        to = std::min(to, -height / rate);
      else
        from = std::max(from, -height / rate);
    }
    if (to - from > shortest) blocks.insert(part.block);
  }
  return blocks;
}

}  // namespace cupola
