#include "generators/stereotomy/internal_faces.hpp"

#include <algorithm>

#include "assembly/model/polygon_parts.hpp"

namespace cupola {
namespace {

/// True if two faces are the same polygon, seen from its two sides; beyond a gap they need not be parallel.
bool coincide(const PlanePolygon& a, const PlanePolygon& b, double distance) {
  if (a.corners.size() != b.corners.size() || a.plane.normal.dot(b.plane.normal) >= 0.0) return false;
  return std::ranges::all_of(a.corners, [&](const Vec3& p) {
    return std::ranges::any_of(b.corners, [&](const Vec3& q) { return (p - q).norm() < distance; });
  });
}

}  // namespace

void mark_internal_faces(size_t first_part, double distance, Assembly* assembly) {
  const std::vector<Part>& parts = assembly->parts;
  for (size_t p = first_part, end = p; p < parts.size(); p = end) {
    while (end < parts.size() && parts[end].block == parts[p].block) ++end;
    if (end == p + 1) continue;
    const std::vector<PlanePolygon> faces = faces_of_block(*assembly, parts[p].block);
    for (size_t f = 0; f < faces.size(); ++f)
      if (uncovered(faces[f], faces, distance).empty() ||
          std::ranges::any_of(faces, [&](const auto& other) { return coincide(faces[f], other, distance); }))
        assembly->face_kinds[parts[p].face_start + f] = FaceKind::internal;
  }
}

}  // namespace cupola
