#pragma once

#include <cmath>
#include <numbers>

#include "postproc/mechanics/shell.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::test {

inline constexpr int kRound = 8;             ///< stones round the key stone, at multiples of 45 degrees
inline const Vec3 kPush = {-0.5, 0.0, 0.2};  ///< N, of the first of them on it

/// A ring of eight wedges and the key stone that closes it, block 8 of ring 1, all turned by `turn`, rad.
/// Its sides lean outwards and are 1 m from the axis at their foot.
struct KeyStone {
  Assembly assembly;
  ContactTable contacts;  ///< the wedges push on the key stone, evenly on each side

  explicit KeyStone(double turn) {
    const double half = std::numbers::pi / kRound;
    Assembly& a = assembly;
    a.num_rings = 2;
    a.sheets = {{"vault", 0, 2, true, Sheet::ThrustLines::by_azimuth}};
    const auto corner = [&](double distance, double angle, double z) {
      const double r = (distance + 0.4 * z) / std::cos(half);
      return Vec3(r * std::cos(angle + turn), r * std::sin(angle + turn), z);
    };
    using enum FaceKind;
    for (int k = 0; k <= kRound; ++k) {
      Block& block = a.blocks.emplace_back();
      block.ring = k == kRound ? 1 : 0;
      block.slot = k % kRound;
      block.density = 1800.0;
      if (k == kRound) break;
      const double angle = 2.0 * half * k;
      for (int i = 0; i < 8; ++i)
        a.vertices.push_back(corner(i & 1 ? 2.0 : 1.0, angle + (i & 2 ? half : -half), i & 4 ? 0.5 : 0.0));
      add_hexahedron(&a, k, 0, {intrados, extrados, bed, bed, head, head});
    }
    const int first = static_cast<int>(a.vertices.size());
    for (int i = 0; i < 2 * kRound; ++i)
      a.vertices.push_back(corner(1.0, half * (2 * (i / 2) - 1), i % 2 ? 0.5 : 0.0));
    a.parts.push_back({kRound, 1, 0, a.num_faces(), 0, 0.0});
    std::vector<int> under, over;
    for (int k = 0; k < kRound; ++k) {
      const int low = first + 2 * k, next = first + 2 * ((k + 1) % kRound);
      a.add_face(std::array{low, next, next + 1, low + 1}, bed);
      under.insert(under.begin(), low);
      over.push_back(low + 1);
    }
    a.add_face(under, intrados);
    a.add_face(over, extrados);
    compute_mass_properties(&a);
    for (int k = 0; k < kRound; ++k) push(k, turn, corner);
  }

 private:
  template <typename Corner>
  void push(int stone, double turn, const Corner& corner) {
    const double half = std::numbers::pi / kRound, angle = 2.0 * half * stone;
    const Vec3 force = Eigen::AngleAxisd(angle + turn, Vec3::UnitZ()) * kPush;
    ContactTable& c = contacts;
    for (int i = 0; i < 4; ++i) {
      c.joint.push_back(stone);
      c.block_a.push_back(stone);
      c.block_b.push_back(kRound);
      c.kind.push_back(JointKind::bed);
      c.ring.push_back(1);
      c.point.push_back(corner(1.0, angle + (i & 1 ? half : -half), i & 2 ? 0.5 : 0.0));
      c.normal.push_back(force.normalized());
      c.force.push_back(0.25 * force);
      c.normal_force.push_back(0.25 * force.norm());
      c.area.push_back(0.1);
      for (auto* zero : {&c.gap, &c.friction_use, &c.slip, &c.law_violation}) zero->push_back(0.0);
    }
  }
};

}  // namespace cupola::test
