#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "assembly/model/assembly.hpp"

namespace cupola::testing {

/// A box with its own vertices. In the axes of the box, the upper and lower faces are beds and the other four
/// are heads.
struct BoxSpec {
  Vec3 center = Vec3::Zero();  ///< m
  Vec3 size = Vec3::Ones();    ///< m
  double density = 1000.0;     ///< kg/m3
  bool fixed = false;
  int ring = 0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Adds a block with the density, kind and ring of `box`, without parts.
inline void add_block(const BoxSpec& box, Assembly* assembly) {
  Block block;
  block.kind = box.fixed ? BlockKind::support : BlockKind::standard;
  block.fixed = box.fixed;
  block.ring = box.fixed ? -1 : box.ring;
  block.slot = static_cast<int>(assembly->blocks.size());
  block.density = box.density;
  assembly->blocks.push_back(block);
}

/// Adds the box to the last block as a convex part. `internal_low` and `internal_high` mark its face at -x or
/// +x as internal, for another part of the block behind it.
inline void add_box_part(const BoxSpec& box, bool internal_low, bool internal_high, Assembly* assembly) {
  const int first = static_cast<int>(assembly->vertices.size());
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) ? 0.5 : -0.5, (k & 2) ? 0.5 : -0.5, (k & 4) ? 0.5 : -0.5);
    assembly->vertices.push_back(box.center + box.rotation * corner.cwiseProduct(box.size));
  }
  Part part;
  part.block = static_cast<int>(assembly->blocks.size()) - 1;
  part.ring = assembly->blocks.back().ring;
  part.face_start = assembly->num_faces();
  assembly->parts.push_back(part);
  // -z, +z, -y, +y, -x, +x; counter-clockwise from outside.
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (size_t f = 0; f < faces.size(); ++f) {
    std::array<int, 4> ids{};
    for (size_t i = 0; i < 4; ++i) ids[i] = first + faces[f][i];
    const bool internal = (f == 4 && internal_low) || (f == 5 && internal_high);
    assembly->add_face(ids, internal ? FaceKind::internal : f < 2 ? FaceKind::bed : FaceKind::head);
  }
}

/// Adds a block that is one box.
inline void add_box(const BoxSpec& box, Assembly* assembly) {
  add_block(box, assembly);
  add_box_part(box, false, false, assembly);
}

inline Assembly make_boxes(const std::vector<BoxSpec>& boxes) {
  Assembly assembly;
  assembly.title = "boxes";
  for (const BoxSpec& box : boxes) add_box(box, &assembly);
  compute_mass_properties(&assembly);
  return assembly;
}

/// A fixed floor with its upper face at z = 0, and a box on it.
inline Assembly box_on_floor(const Vec3& size, double density = 1000.0) {
  return make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                     {.center = {0, 0, 0.5 * size.z()}, .size = size, .density = density}});
}

/// Stack of cubes of the given side on a fixed floor; cube k from below has the density `densities[k]`.
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

/// Wall in running bond along x on a fixed slab that extends 1 m beyond it. Even courses have whole blocks,
/// odd courses end in half blocks. Each block consists of `slices` parts along its length.
inline Assembly running_bond_wall(const Vec3& block_size, int blocks_per_course, int courses,
                                  int slices = 1) {
  const double length = blocks_per_course * block_size.x();
  Assembly assembly = make_boxes({{.center = {length / 2, block_size.y() / 2, -0.5},
                                   .size = {length + 2, block_size.y() + 2, 1},
                                   .fixed = true}});
  for (int k = 0; k < courses; ++k) {
    const int num_blocks = blocks_per_course + k % 2;
    for (int j = 0; j < num_blocks; ++j) {
      const double low = std::max(0.0, (j - (k % 2) * 0.5) * block_size.x());
      const double high = std::min(length, (j + 1 - (k % 2) * 0.5) * block_size.x());
      const double width = (high - low) / slices;
      BoxSpec slice{.size = {width, block_size.y(), block_size.z()}, .ring = k};
      add_block(slice, &assembly);
      for (int s = 0; s < slices; ++s) {
        slice.center = {low + (s + 0.5) * width, block_size.y() / 2, (k + 0.5) * block_size.z()};
        add_box_part(slice, s > 0, s < slices - 1, &assembly);
      }
    }
  }
  compute_mass_properties(&assembly);
  return assembly;
}

/// The scene scaled about the origin, then moved.
inline Assembly transformed(Assembly assembly, const Eigen::Isometry3d& motion, double scale = 1.0) {
  for (Vec3& x : assembly.vertices) x = motion * (scale * x);
  compute_mass_properties(&assembly);
  return assembly;
}

}  // namespace cupola::testing
