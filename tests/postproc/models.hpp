#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>

#include "assembly/files/assembly_file.hpp"
#include "assembly/files/results_file.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::test {

/// Adds a part whose corners are the last eight vertices: bit 0 of a corner's number counts along the first
/// direction, bit 1 along the second, bit 2 upwards. `kinds`: bottom, top, low and high side of the first
/// direction, low and high side of the second.
inline void add_hexahedron(Assembly* a, int block, int ring, const std::array<FaceKind, 6>& kinds) {
  const int v = static_cast<int>(a->vertices.size()) - 8;
  a->parts.push_back({block, ring, 0, a->num_faces(), 0, 0.0});
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2},
                                {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};
  for (int f = 0; f < 6; ++f) {
    std::array<int, 4> ids{};
    for (int i = 0; i < 4; ++i) ids[i] = v + kFaces[f][i];
    a->add_face(ids, kinds[f]);
  }
}

inline void add_box(Assembly* a, int block, int ring, const Vec3& low, const Vec3& high, FaceKind upper) {
  for (int i = 0; i < 8; ++i)
    a->vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                             i & 4 ? high.z() : low.z());
  using enum FaceKind;
  add_hexahedron(a, block, ring, {bed, upper, head, head, intrados, extrados});
}

/// A support and a column of `n` blocks, each 1.2 x 0.8 x 0.5 m, numbered upwards from 1. The intrados and
/// extrados faces are normal to y.
inline Assembly column(int n, double density = 1800.0) {
  Assembly a;
  a.title = "Column";
  a.num_rings = n;
  a.sheets = {{.name = "wall", .num_rings = n}};
  a.geometry_hash = "geometry of the column";
  Block support;
  support.kind = BlockKind::support;
  support.fixed = true;
  support.ring = -1;
  support.density = density;
  a.blocks.push_back(support);
  add_box(&a, 0, -1, {-1, -1, -0.5}, {2.2, 1.8, 0.0}, FaceKind::bed);
  for (int k = 0; k < n; ++k) {
    Block block;
    block.ring = k;
    block.density = density;
    a.blocks.push_back(block);
    add_box(&a, k + 1, k, {0, 0, 0.5 * k}, {1.2, 0.8, 0.5 * (k + 1)},
            k + 1 == n ? FaceKind::top : FaceKind::bed);
  }
  compute_mass_properties(&a);
  return a;
}

/// The column at rest under gravity g and a load on top. The four corners of every bed carry the weight
/// above, divided so that the resultant acts at (x, y).
inline Frame column_at_rest(const Assembly& a, double g, double load, double x, double y) {
  Frame frame;
  ContactTable& c = frame.contacts;
  double above = load;
  for (size_t b = a.blocks.size() - 1; b >= 1; --b) {
    above += a.blocks[b].mass * g;
    for (int corner = 0; corner < 4; ++corner) {
      const double share = (corner & 1 ? x / 1.2 : 1.0 - x / 1.2) * (corner & 2 ? y / 0.8 : 1.0 - y / 0.8);
      c.joint.push_back(static_cast<int>(b) - 1);
      c.block_a.push_back(static_cast<int>(b) - 1);
      c.block_b.push_back(static_cast<int>(b));
      c.kind.push_back(b == 1 ? JointKind::base : JointKind::bed);
      c.ring.push_back(a.blocks[b].ring);
      c.point.emplace_back(corner & 1 ? 1.2 : 0.0, corner & 2 ? 0.8 : 0.0, 0.5 * a.blocks[b].ring);
      c.normal.push_back(Vec3::UnitZ());
      c.gap.push_back(0.0);
      c.force.emplace_back(0.0, 0.0, share * above);
      c.normal_force.push_back(share * above);
      c.friction_use.push_back(0.0);
      c.area.push_back(0.24);
      c.slip.push_back(0.0);
      c.law_violation.push_back(0.0);
    }
  }
  for (const Block& block : a.blocks) {
    frame.blocks.position.push_back(block.centroid);
    frame.blocks.quaternion_wxyz.emplace_back(1, 0, 0, 0);
    for (auto* v : {&frame.blocks.velocity, &frame.blocks.angular_velocity, &frame.blocks.displacement})
      v->push_back(Vec3::Zero());
  }
  return frame;
}

/// The column as two blocks of an inner wythe, half as thick as the shell, and a bonder on top.
inline Assembly column_with_wythes() {
  Assembly a = column(3);
  a.members = {"inner", "outer", "bonder"};
  a.blocks[3].member = 2;
  a.vertex_layers.assign(a.vertices.size(), -1);
  a.vertex_depths.assign(a.vertices.size(), 0.0);
  for (size_t v = 8; v < a.vertices.size(); ++v) {  // behind the support, eight per block
    const bool outside = a.vertices[v].y() > 0.0;
    a.vertex_layers[v] = !outside ? 0 : v < 24 ? 1 : 2;
    a.vertex_depths[v] = !outside ? 0.0 : v < 24 ? 0.5 : 1.0;
  }
  return a;
}

/// The column at rest, with a tie from block 1 to block 3 under 1234 N.
inline Frame column_with_a_tie(const Assembly& a) {
  Frame frame = column_at_rest(a, 9.81, 0.0, 0.5, 0.3);
  frame.ties.chain = {-1};
  frame.ties.block_a = {1};
  frame.ties.block_b = {3};
  frame.ties.point_a = {Vec3(0.5, 0.4, 0.25)};
  frame.ties.point_b = {Vec3(0.5, 0.4, 1.25)};
  frame.ties.force = {1234.0};
  frame.ties.yield_force = {1e6};
  frame.ties.yielded = {0.0};
  frame.ties.strut = {0};
  return frame;
}

/// A vault of revolution about z in running bond, without supports. Every block is one hexahedron; beds lie
/// on cones.
inline Assembly ring_vault(int rings, int blocks_per_ring, double offset) {
  Assembly a;
  a.num_rings = rings;
  a.sheets = {{"vault", 0, rings, true, Sheet::ThrustLines::by_azimuth}};
  const double width = 2.0 * std::numbers::pi / blocks_per_ring;
  for (int k = 0; k < rings; ++k) {
    for (int s = 0; s < blocks_per_ring; ++s) {
      const double from = offset + (s + (k % 2 ? 0.5 : 0.0)) * width;
      for (int i = 0; i < 8; ++i) {
        const double r = i & 1 ? 11.0 : 10.0, angle = from + (i & 2 ? width : 0.0);
        const double t = 0.02 * (i & 4 ? k + 1 : k), rho = r * std::cos(t) - 3.0;
        a.vertices.emplace_back(rho * std::cos(angle), rho * std::sin(angle), r * std::sin(t));
      }
      Block block;
      block.ring = k;
      block.slot = s;
      block.density = 1800.0;
      a.blocks.push_back(block);
      using enum FaceKind;
      add_hexahedron(&a, static_cast<int>(a.blocks.size()) - 1, k,
                     {bed, k + 1 == rings ? top : bed, intrados, extrados, head, head});
    }
  }
  compute_mass_properties(&a);
  return a;
}

}  // namespace cupola::test
