#include "postproc/mechanics/skin_facet.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "postproc/mechanics/cut_facet.hpp"

namespace cupola::skin_facet_test {
namespace {

constexpr double kThickness = 0.8, kLong = 1.0, kShort = 0.3;  // m, of the stone and its legs

/// A prism 1 m high on the given outline, with the kinds of its sides.
void add_prism(Assembly* a, const std::vector<Vec3>& outline, const std::vector<FaceKind>& sides) {
  const int first = static_cast<int>(a->vertices.size()), n = static_cast<int>(outline.size());
  a->parts.push_back({.face_start = a->num_faces()});
  for (const double z : {0.0, 1.0})
    for (const Vec3& p : outline) a->vertices.push_back(p + z * Vec3::UnitZ());
  std::vector<int> below, above;
  for (int i = 0; i < n; ++i) {
    below.push_back(first + n - 1 - i);
    above.push_back(first + n + i);
  }
  a->add_face(below, FaceKind::bed);
  a->add_face(above, FaceKind::top);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    a->add_face({{first + i, first + j, first + n + j, first + n + i}}, sides[i]);
  }
}

/// A stone bent by 45 degrees, cut along the inside of its long leg: the cut comes out at the end of the
/// short one, so that the inner edge of one part runs on along the other and that has no outer edge.
Assembly bent_stone() {
  const double c = std::sqrt(0.5);
  const Vec3 bend(0, 0, 0), long_in(kLong, 0, 0), long_out(kLong, -kThickness, 0);
  const Vec3 mitre(-kThickness * std::tan(std::atan(1.0) / 2.0), -kThickness, 0);
  const Vec3 short_in(-kShort * c, kShort * c, 0), short_out = short_in - kThickness * Vec3(c, c, 0);
  const Vec3 cut(-2.0 * kShort * c, 0, 0);
  Assembly a;
  a.num_rings = 1;
  a.blocks.emplace_back();
  using enum FaceKind;
  add_prism(&a, {cut, short_out, mitre, long_out, long_in}, {head, extrados, extrados, head, intrados});
  add_prism(&a, {bend, short_in, cut}, {intrados, head, internal});
  return a;
}

TEST(SkinFacet, FollowsTheBendOfAStoneHoweverThatIsCut) {
  const Assembly a = bent_stone();
  for (const FaceKind kind : {FaceKind::bed, FaceKind::top}) {
    std::vector<BedFacet> bed;
    for (const Part& part : a.parts)
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        if (a.face_kinds[f] == kind) add_skin_facet(a, part, f, &bed);
    ASSERT_EQ(bed.size(), 2u);
    double inner = 0.0;
    for (const BedFacet& f : bed) {
      const Vec3 along = (f.intrados_b - f.intrados_a).normalized();
      for (const Vec3& corner : {f.extrados_a, f.extrados_b})
        EXPECT_NEAR(along.cross(corner - f.intrados_a).norm(), kThickness, 1e-12);  // rounding
      EXPECT_NEAR(along.cross(f.extrados_b - f.extrados_a).norm(), 0.0, 1e-12);
      inner += (f.intrados_b - f.intrados_a).norm();
    }
    EXPECT_NEAR(inner, kLong + kShort, 1e-12);
  }
}

// As of a stone at a groin, whose outer edge the mitre has cut away.
TEST(SkinFacet, OfATriangleIsTheRectangleAroundIt) {
  Assembly a;
  a.num_rings = 1;
  a.blocks.emplace_back();
  add_prism(&a, {{0, 0, 0}, {kLong, 0, 0}, {0.2, kThickness, 0}},
            {FaceKind::intrados, FaceKind::head, FaceKind::head});
  std::vector<BedFacet> bed;
  add_skin_facet(a, a.parts[0], 0, &bed);
  EXPECT_TRUE(bed.empty());
  add_cut_facets(a, std::vector{BedFace{&a.parts[0], 0}}, &bed);
  ASSERT_EQ(bed.size(), 1u);
  EXPECT_NEAR((bed[0].intrados_b - bed[0].intrados_a).norm(), kLong, 1e-12);  // rounding
  for (const Vec3& corner : {bed[0].intrados_a, bed[0].intrados_b}) EXPECT_NEAR(corner.y(), 0.0, 1e-12);
  for (const Vec3& corner : {bed[0].extrados_a, bed[0].extrados_b})
    EXPECT_NEAR(corner.y(), kThickness, 1e-12);
  add_cut_facets(a, std::vector{BedFace{&a.parts[0], 0}}, &bed);
  EXPECT_EQ(bed.size(), 1u) << "the block has a facet";
}

}  // namespace
}  // namespace cupola::skin_facet_test
