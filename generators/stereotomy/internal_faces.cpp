#include "generators/stereotomy/internal_faces.hpp"

#include <algorithm>

namespace cupola {
namespace {

/// True if two faces are the same polygon, seen from its two sides.
bool coincide(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double distance) {
  if (a.size() != b.size() || polygon_plane(a).normal.dot(polygon_plane(b).normal) >= 0.0) return false;
  return std::ranges::all_of(a, [&](const Vec3& p) {
    return std::ranges::any_of(b, [&](const Vec3& q) { return (p - q).norm() < distance; });
  });
}

}  // namespace

void mark_internal_faces(size_t first_part, double distance, Assembly* assembly) {
  const std::vector<Part>& parts = assembly->parts;
  for (size_t p = first_part; p < parts.size(); ++p)
    for (size_t q = p + 1; q < parts.size() && parts[q].block == parts[p].block; ++q)
      for (int f = parts[p].face_start; f < parts[p].face_start + parts[p].num_faces; ++f) {
        const std::vector<Vec3> points = face_points(*assembly, f);
        for (int g = parts[q].face_start; g < parts[q].face_start + parts[q].num_faces; ++g)
          if (coincide(points, face_points(*assembly, g), distance))
            assembly->face_kinds[f] = assembly->face_kinds[g] = FaceKind::internal;
      }
}

}  // namespace cupola
