// Fill on faces and forces that spread through it, against closed forms.

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "assembly/model/fill_pressure.hpp"

namespace cupola::loaded_faces_test {
namespace {

const Vec3 kGravity(0.0, 0.0, -9.81);

LoadedFace face_of(std::vector<Vec3> polygon) {
  LoadedFace face;
  face.centroid = polygon_centroid(polygon);
  face.normal = polygon_plane(polygon).normal;
  face.area = polygon_area(polygon);
  face.polygon = std::move(polygon);
  return face;
}

/// From z = 0 at x = 0 to z = 2 at x = 3, 4 m wide; it looks up and towards -x.
LoadedFace slope() {
  return face_of({{0, 0, 0}, {3, 0, 2}, {3, 4, 2}, {0, 4, 0}});
}

// The weight of the wedge above it: section 3 (5 + 3) / 2 = 12 m2.
TEST(Fill, WeighsWhatLiesAboveAFace) {
  const Resultant r = fill_force({.level = 5.0, .from = {}, .unit_weight = 20e3}, slope(), kGravity);
  EXPECT_NEAR(r.force.z(), -20e3 * 12.0 * 4.0, 1e-9);
  EXPECT_EQ(r.force.head<2>().norm(), 0.0);
  EXPECT_NEAR(r.point.x(), (22.5 - 6.0) / 12.0, 1e-14) << "centroid of the trapezium";
  EXPECT_NEAR(r.point.y(), 2.0, 1e-14);
}

// Earth pressure on the height of 2 m: k gamma (5^2 - 3^2) / 2, in +x.
TEST(Fill, PressesSidewaysByItsShare) {
  const Resultant r =
      fill_force({.level = 5.0, .from = {}, .unit_weight = 20e3, .horizontal = 0.4}, slope(), kGravity);
  EXPECT_NEAR(r.force.x(), 0.4 * 20e3 * 8.0 * 4.0, 1e-9);
  const LoadedFace below = face_of({{0, 4, 0}, {3, 4, 2}, {3, 0, 2}, {0, 0, 0}});
  const Resultant of_below =
      fill_force({.level = 5.0, .from = {}, .unit_weight = 20e3, .horizontal = 0.4}, below, kGravity);
  EXPECT_EQ(of_below.force.z(), 0.0) << "it looks down";
  EXPECT_NEAR(of_below.force.x(), -0.4 * 20e3 * 8.0 * 4.0, 1e-9);
}

// Fill lies on the tread of a step, and so against its riser above it and under an overhang, not against the
// free sides of the wall below the step, nor below an overhang above nothing.
TEST(Fill, PressesOnWhatItLiesAgainst) {
  const LoadedFace tread = face_of({{0, 0, 0}, {1, 0, 0}, {1, 4, 0}, {0, 4, 0}}),
                   riser = face_of({{0, 0, -1}, {0, 6, -1}, {0, 6, 2}, {0, 0, 2}}),
                   overhang = face_of({{0, 0, 2}, {0, 4, 2}, {0.5, 4, 3}, {0.5, 0, 3}}),
                   outer = face_of({{1, 4, 0}, {1, 0, 0}, {1, 0, -3}, {1, 4, -3}}),
                   inner = face_of({{-1, 0, 0}, {-1, 4, 0}, {-1, 4, -3}, {-1, 0, -3}}),
                   end = face_of({{0, 4, 0}, {1, 4, 0}, {1, 4, -3}, {0, 4, -3}});
  ASSERT_EQ(riser.normal, Vec3::UnitX());
  ASSERT_EQ(outer.normal, Vec3::UnitX());
  ASSERT_LT(overhang.normal.z(), 0.0);
  const std::vector faces{tread, riser, overhang, outer, inner, end};
  const Fill fill{.level = 5.0, .from = {}, .unit_weight = 1.0};
  const std::vector<LoadedFace> pressed = beside_fill(fill, faces, std::vector{tread}, 0.01);
  ASSERT_EQ(pressed.size(), 2u);
  EXPECT_NEAR((pressed[0].centroid - Vec3(0.0, 2.0, 1.0)).norm(), 0.0, 1e-15) << "beside the tread, above it";
  EXPECT_NEAR(pressed[0].area, 2.0 * 4.0, 1e-14);
  EXPECT_NEAR(pressed[1].area, overhang.area, 1e-14);
  EXPECT_TRUE(beside_fill(fill, faces, {}, 0.01).empty());
}

// Layers add up: backing up to 1 m, and soil above it that rests on the backing or on the face.
TEST(Fill, LayersAddUp) {
  const Fill backing{.level = 1.0, .from = {}, .unit_weight = 20e3},
      soil{.level = 5.0, .from = 1.0, .unit_weight = 20e3},
      all{.level = 5.0, .from = {}, .unit_weight = 20e3};
  const Resultant a = fill_force(backing, slope(), kGravity), b = fill_force(soil, slope(), kGravity),
                  c = fill_force(all, slope(), kGravity);
  EXPECT_NEAR(a.force.z(), -20e3 * 0.5 * 1.5 * 4.0, 1e-9) << "a triangle of 1.5 by 1 m";
  EXPECT_NEAR((a.force + b.force - c.force).norm(), 0.0, 1e-9);
  EXPECT_NEAR((a.force.z() * a.point + b.force.z() * b.point - c.force.z() * c.point).norm(), 0.0, 1e-8);
}

TEST(Fill, WeighsAlongGravity) {
  const Fill soil{.level = 5.0, .from = {}, .unit_weight = 20e3};
  const Vec3 tilted(0.3 * 9.81, 0.0, -9.81);
  EXPECT_NEAR(fill_force(soil, slope(), tilted).force.x(), 0.3 * 20e3 * 48.0, 1e-9);
  EXPECT_EQ(fill_force({.level = -1.0, .from = {}, .unit_weight = 20e3}, slope(), kGravity).force.norm(),
            0.0);
}

// On a level face at a depth of 2 m the rectangle of 0.3 by 2 m has grown to 2.3 by 4 m.
TEST(SpreadForce, LoadsTheWidenedRectangle) {
  std::vector<LoadedFace> faces;
  for (int i = 0; i < 8; ++i)
    faces.push_back(
        face_of({{0.5 * i, -5, 0}, {0.5 * i + 0.5, -5, 0}, {0.5 * i + 0.5, 5, 0}, {0.5 * i, 5, 0}}));
  const std::vector<SpreadShare> shares = spread_shares({0.3, 2.0, 0.5}, {2.0, 0.0, 2.0}, faces);
  ASSERT_EQ(shares.size(), 6u) << "from x = 0.85 to 3.15 m";
  double sum = 0.0;
  Vec3 centre = Vec3::Zero();
  for (const SpreadShare& share : shares) {
    sum += share.share;
    centre += share.share * share.point;
  }
  EXPECT_NEAR(sum, 1.0, 1e-15);
  EXPECT_NEAR((centre - Vec3(2.0, 0.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(shares.front().share, 0.15 / 2.3, 1e-15);
  EXPECT_NEAR(shares[2].share, 0.5 / 2.3, 1e-15);
}

// On the face z = k x the ray u meets x = u A / (1 + c u), with A = X + 2 m H and c = 2 m k: the mean over u
// is A (1 / c - ln((1 + c / 2) / (1 - c / 2)) / c^2). The rule of ten by ten points reaches rounding, here of
// two triangles.
TEST(SpreadForce, ActsWhereItsRaysMeetASteepFace) {
  const double k = 0.8, slope = 0.5, width = 0.3, height = 2.0;
  const std::vector<LoadedFace> faces{
      face_of({{-9, -9, -9 * k}, {9, -9, 9 * k}, {9, 9, 9 * k}, {-9, 9, -9 * k}})};
  const std::vector<SpreadShare> shares = spread_shares({width, 2.0, slope}, {0.0, 0.0, height}, faces);
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_NEAR(shares[0].share, 1.0, 1e-15);
  const double c = 2.0 * slope * k, x = (width + 2.0 * slope * height) *
                                        (1.0 / c - std::log((1.0 + 0.5 * c) / (1.0 - 0.5 * c)) / (c * c));
  EXPECT_NEAR((shares[0].point - Vec3(x, 0.0, k * x)).norm(), 0.0, 1e-12);
}

TEST(SpreadForce, ReachesOnlyFacesBelowThatLookUp) {
  const std::vector<LoadedFace> faces{slope(), face_of({{0, 0, 9}, {1, 0, 9}, {1, 1, 9}, {0, 1, 9}}),
                                      face_of({{0, 0, 0}, {0, 0, 3}, {0, 4, 3}, {0, 4, 0}})};
  const std::vector<SpreadShare> shares = spread_shares({1.0, 1.0, 0.0}, {1.0, 1.0, 4.0}, faces);
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_NEAR((shares[0].point - Vec3(1.0, 1.0, 2.0 / 3.0)).norm(), 0.0, 1e-14);
  EXPECT_TRUE(spread_shares({1.0, 1.0, 0.5}, {50.0, 1.0, 4.0}, faces).empty());
}

}  // namespace
}  // namespace cupola::loaded_faces_test
