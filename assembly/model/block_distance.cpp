#include "assembly/model/block_distance.hpp"

#include <algorithm>
#include <limits>

namespace cupola {

double distance_from_part(const Assembly& assembly, const Part& part, const Vec3& point) {
  double outside = -std::numeric_limits<double>::infinity();
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const Plane plane = polygon_plane(face_points(assembly, f));
    outside = std::max(outside, plane.normal.dot(point) - plane.offset);
  }
  return outside;
}

std::span<const Part> parts_of_block(const Assembly& assembly, int block) {
  const auto first = std::ranges::lower_bound(assembly.parts, block, {}, &Part::block),
             end = std::ranges::upper_bound(assembly.parts, block, {}, &Part::block);
  return {first, end};
}

double distance_from_block(const Assembly& assembly, int block, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_of_block(assembly, block))
    least = std::min(least, distance_from_part(assembly, part, point));
  return least;
}

}  // namespace cupola
