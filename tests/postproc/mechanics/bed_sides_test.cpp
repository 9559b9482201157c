#include "postproc/mechanics/bed_sides.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "postproc/mechanics/shell.hpp"

namespace cupola::bed_sides_test {
namespace {

/// A wall of courses 0.2 m high under a top that falls by 1 in 20: blocks of 1 x 0.5 m, 20, 16 and 12 of a
/// course. Blocks share their corners.
Assembly wing_wall() {
  constexpr std::array kBlocks{20, 16, 12};
  Assembly a;
  a.num_rings = static_cast<int>(kBlocks.size());
  a.sheets = {{.name = "wall", .num_rings = a.num_rings}};
  const int across = kBlocks[0] + 1;
  for (int level = 0; level <= a.num_rings; ++level)
    for (const double y : {0.0, 0.5})
      for (int i = 0; i < across; ++i) a.vertices.emplace_back(i, y, 0.2 * level);
  using enum FaceKind;
  for (int k = 0; k < a.num_rings; ++k)
    for (int i = 0; i < kBlocks[k]; ++i) {
      Block block;
      block.ring = k;
      block.density = 2000.0;
      a.parts.push_back({static_cast<int>(a.blocks.size()), k, 0, a.num_faces()});
      a.blocks.push_back(block);
      const auto at = [&](int x, int y, int z) { return (2 * (k + z) + y) * across + i + x; };
      a.add_face(std::array{at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)}, bed);
      a.add_face(std::array{at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, k == 2 ? top : bed);
      a.add_face(std::array{at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}, head);
      a.add_face(std::array{at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}, head);
      a.add_face(std::array{at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, intrados);
      a.add_face(std::array{at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)}, extrados);
    }
  compute_mass_properties(&a);
  return a;
}

// The centroids of its courses lie 2 m beside each other and 0.2 m above.
TEST(BedSides, FollowFromThePartsThatMateNotFromTheCentroidsOfCourses) {
  const Assembly a = wing_wall();
  const BedSides sides(a, a.num_rings);
  for (const Vec3& direction : sides.progress())
    EXPECT_NEAR((direction - Vec3::UnitZ()).norm(), 0.0, 1e-12);  // rounding
  for (const Part& part : a.parts) {
    EXPECT_EQ(sides.side_of(part, part.face_start), -1) << "block " << part.block;
    EXPECT_EQ(sides.side_of(part, part.face_start + 1), 1) << "block " << part.block;
  }
  const Shell shell = shell_of(a, Vec3::UnitZ());
  ASSERT_EQ(shell.beds.size(), 4u);
  EXPECT_EQ(shell.beds[0].size(), 20u);
  EXPECT_EQ(shell.beds[1].size(), 16u);
  EXPECT_EQ(shell.beds[2].size(), 12u);
  EXPECT_EQ(shell.beds[3].size(), 12u) << "closes the wall";
}

// A skewback through several courses looks up, and shares its lower edge with the course below.
TEST(BedSides, OfASkewbackFollowFromItsNormal) {
  Assembly a = wing_wall();
  const Part& last = a.parts.back();
  const int head = last.face_start + 3;
  for (const int v : a.face(head))
    if (a.vertices[v].z() > 0.5) a.vertices[v].x() -= 0.1;
  a.face_kinds[head] = FaceKind::bed;
  EXPECT_EQ(BedSides(a, a.num_rings).side_of(last, head), 1);
}

}  // namespace
}  // namespace cupola::bed_sides_test
