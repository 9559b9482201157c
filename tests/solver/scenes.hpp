#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "assembly/assembly.hpp"

namespace cupola::testing {

/// A box of the given size about a centre, with its own vertices; upper and lower faces are beds, the four
/// others heads, seen in the box's axes.
struct BoxSpec {
  Vec3 center = Vec3::Zero();  ///< m
  Vec3 size = Vec3::Ones();    ///< m
  double density = 1000.0;     ///< kg/m3
  bool fixed = false;
  int ring = 0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

inline void add_box(const BoxSpec& box, Assembly* assembly) {
  const int first = static_cast<int>(assembly->vertices.size());
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) ? 0.5 : -0.5, (k & 2) ? 0.5 : -0.5, (k & 4) ? 0.5 : -0.5);
    assembly->vertices.push_back(box.center + box.rotation * corner.cwiseProduct(box.size));
  }
  Block block;
  block.kind = box.fixed ? BlockKind::support : BlockKind::standard;
  block.fixed = box.fixed;
  block.ring = box.fixed ? -1 : box.ring;
  block.slot = static_cast<int>(assembly->blocks.size());
  block.density = box.density;
  Part part;
  part.block = static_cast<int>(assembly->blocks.size());
  part.ring = block.ring;
  part.face_start = assembly->num_faces();
  assembly->blocks.push_back(block);
  assembly->parts.push_back(part);
  // -z, +z, -y, +y, -x, +x; counter-clockwise from outside.
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (size_t f = 0; f < faces.size(); ++f) {
    std::array<int, 4> ids{};
    for (size_t i = 0; i < 4; ++i) ids[i] = first + faces[f][i];
    assembly->add_face(ids, f < 2 ? FaceKind::bed : FaceKind::head);
  }
}

inline Assembly make_boxes(const std::vector<BoxSpec>& boxes) {
  Assembly assembly;
  assembly.title = "boxes";
  for (const BoxSpec& box : boxes) add_box(box, &assembly);
  compute_mass_properties(&assembly);
  return assembly;
}

/// A fixed floor whose upper face is z = 0, and a box on it.
inline Assembly box_on_floor(const Vec3& size, double density = 1000.0) {
  return make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                     {.center = {0, 0, 0.5 * size.z()}, .size = size, .density = density}});
}

/// Cubes of the given side on a fixed floor, cube k of density `densities[k]` at height k.
inline Assembly stack_of_cubes(double side, const std::vector<double>& densities) {
  std::vector<BoxSpec> boxes{
      {.center = {0, 0, -0.5 * side}, .size = {3 * side, 3 * side, side}, .fixed = true}};
  for (size_t k = 0; k < densities.size(); ++k)
    boxes.push_back({.center = {0, 0, (static_cast<double>(k) + 0.5) * side},
                     .size = {side, side, side},
                     .density = densities[k],
                     .ring = static_cast<int>(k)});
  return make_boxes(boxes);
}

}  // namespace cupola::testing
