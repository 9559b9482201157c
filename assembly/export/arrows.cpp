#include "assembly/export/arrows.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

void add_arrow(const Vec3& from, const Vec3& span, double thickness, BlockSurface* surface) {
  const double length = span.norm();
  if (length <= 0.0) return;
  const Vec3 along = span / length;
  const Vec3 side = (std::abs(along.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX()).cross(along).normalized();
  const Vec3 other = along.cross(side);
  const double head = std::min(5.0 * thickness, 0.4 * length),
               half = std::min(0.7 * thickness, 0.07 * length);
  const int first = static_cast<int>(surface->vertices.size());
  const auto add_square = [&](double at, double radius) {
    for (const auto& [u, v] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}})
      surface->vertices.push_back(from + at * along + radius * (u * side + v * other));
  };
  add_square(0.0, half);
  add_square(length - head, half);
  add_square(length - head, 2.5 * half);
  surface->vertices.push_back(from + span);
  const auto add = [&](std::vector<int> face) {
    for (int& v : face) v += first;
    surface->faces.push_back(std::move(face));
  };
  add({3, 2, 1, 0});  // foot
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    add({i, next, 4 + next, 4 + i});          // shaft
    add({4 + i, 4 + next, 8 + next, 8 + i});  // shoulder
    add({8 + i, 8 + next, 12});               // head
  }
}

}  // namespace cupola
