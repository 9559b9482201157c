#include "postproc/mechanics/bed_sides.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace cupola {
namespace {

bool is_arch(const Assembly& assembly, size_t ring) {
  const Sheet* sheet = assembly.sheet_of(static_cast<int>(ring));
  return sheet && sheet->thrust_lines == Sheet::ThrustLines::one;
}

/// Direction from ring to ring: upwards in a vault or wall, where cuts shift the centroids of rings sideways,
/// and in an arch from the centroids of neighbouring rings.
std::vector<Vec3> between_centroids(const Assembly& assembly, int num_rings) {
  std::vector<Vec3> centroid(static_cast<size_t>(num_rings), Vec3::Zero());
  std::vector<double> volume(centroid.size(), 0.0);
  for (const Part& part : assembly.parts) {
    if (part.ring < 0) continue;
    const SolidProperties solid = solid_properties(assembly, part);
    centroid[part.ring] += solid.volume * solid.centroid;
    volume[part.ring] += solid.volume;
  }
  for (size_t k = 0; k < centroid.size(); ++k) centroid[k] /= volume[k];
  std::vector<Vec3> progress(centroid.size(), Vec3::UnitZ());
  for (size_t k = 0; k < centroid.size(); ++k) {
    if (!is_arch(assembly, k)) continue;
    const auto [first, end] = assembly.stack_of(static_cast<int>(k));
    const size_t last = std::min(static_cast<size_t>(end), centroid.size()) - 1;
    const Vec3 d = centroid[std::min(k + 1, last)] - centroid[k > static_cast<size_t>(first) ? k - 1 : k];
    if (d.norm() > 0.0) progress[k] = d.normalized();
  }
  return progress;
}

bool is_joint(FaceKind kind) {
  return kind == FaceKind::bed || kind == FaceKind::top;
}

}  // namespace

BedSides::BedSides(const Assembly& assembly, int num_rings)
    : assembly_(assembly), progress_(between_centroids(assembly, num_rings)) {
  constexpr int kNone = std::numeric_limits<int>::max();
  rings_.assign(assembly.vertices.size(), {kNone, -1});
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; part.ring >= 0 && f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f))
        rings_[v] = {std::min(rings_[v].first, part.ring), std::max(rings_[v].second, part.ring)};

  constexpr double kCancelled = 1e-3;  // of the area, of normals on all sides of an axis
  std::vector<Vec3> normals(progress_.size(), Vec3::Zero());
  std::vector<double> areas(progress_.size(), 0.0);
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; part.ring >= 0 && f < part.face_start + part.num_faces; ++f) {
      if (!is_joint(assembly.face_kinds[f])) continue;
      const std::vector<Vec3> corners = face_points(assembly, f);
      const double area = polygon_area(corners);
      if (const int side = mated_side(part, f); side != 0) {
        normals[part.ring] += side * area * polygon_plane(corners).normal;
        areas[part.ring] += area;
      }
    }
  for (size_t k = 0; k < normals.size(); ++k)
    if (is_arch(assembly, k) && normals[k].norm() > kCancelled * areas[k])
      progress_[k] = normals[k].normalized();
}

int BedSides::mated_side(const Part& part, int face) const {
  int score = 0;
  for (const int v : assembly_.face(face))
    score += (rings_[v].second > part.ring ? 1 : 0) - (rings_[v].first < part.ring ? 1 : 0);
  const int side = (score > 0 ? 1 : 0) - (score < 0 ? 1 : 0);
  // A skewback through several courses shares its lower edge with that of the course below, and looks up.
  constexpr int kEdge = 2;
  if (side == 0 || std::abs(score) > kEdge) return side;
  return side * polygon_plane(face_points(assembly_, face)).normal.dot(progress_[part.ring]) < 0.0 ? 0 : side;
}

int BedSides::side_of(const Part& part, int face) const {
  // Internal faces between slices are perpendicular to the direction from ring to ring; beds are at the crown
  // of a vault nearly so.
  constexpr double kSideways = 0.1, kRounding = 1e-6;
  const bool joint = is_joint(assembly_.face_kinds[face]);
  if (const int side = mated_side(part, face); side != 0 && joint) return side;
  const double along = polygon_plane(face_points(assembly_, face)).normal.dot(progress_[part.ring]);
  const double least = joint ? kRounding : kSideways;
  return (along > least ? 1 : 0) - (along < -least ? 1 : 0);
}

}  // namespace cupola
