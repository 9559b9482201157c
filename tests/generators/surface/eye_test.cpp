// The eye of a vault over a closed plan: where its last bed lies, and what is refused.

#include <string>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/surface/make_surface.hpp"

namespace cupola::eye_test {
namespace {

VaultSurface vault(Profile::Kind profile, double eye) {
  VaultSurface v;
  v.profile.kind = profile;
  v.profile.span = 4.0;
  v.profile.height = 3.0;
  v.thickness = 0.3;
  v.eye = eye;
  return v;
}

std::string refusal(const VaultSurface& surface) {
  try {
    make_surface(surface, 4);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Eye, LiesInsideTheSpringing) {
  for (const double eye : {2.0, 2.5})
    expect_part(refusal(vault(Profile::Kind::semicircle, eye)),
                "must be below 2 m, the largest r of the profile");
  expect_part(refusal(vault(Profile::Kind::semicircle, 2.5)), "geometry.surface.eye = 2.5: ");
}

TEST(Eye, LiesOnTheProfile) {
  VaultSurface leaning = vault(Profile::Kind::straight, 1.0);
  leaning.profile.batter = 0.2;
  expect_part(refusal(leaning), "geometry.surface.eye = 1: the profile ends at r = 1.4 m");
  VaultSurface closed = vault(Profile::Kind::chain, 0.5);
  closed.profile.points = {{2.0, 1.5, 1.0}, {0.0, 1.0, 1.3}, {}, {}};
  closed.key_stone = true;
  expect_part(refusal(closed), "geometry.surface.eye = 0.5: the profile ends at r = 1 m");
}

// No eye fits an upright profile. Each message names the cure that is left, and does not send to the other.
TEST(Eye, OfAnUprightProfileIsLeftOut) {
  for (const double eye : {1.0, 2.0, 2.5})
    expect_part(refusal(vault(Profile::Kind::straight, eye)),
                "the profile is nowhere wider than at its end, r = 2 m; leave out `eye` and key_stone");
  VaultSurface solid = vault(Profile::Kind::straight, 0.0);
  solid.line = VaultSurface::Line::extrados;
  solid.thickness = 2.0;
  expect_part(refusal(solid), "geometry.surface.thickness: on the last bed the drawn line lies at r = 2 m");
  solid.thickness = 1.9;
  EXPECT_EQ(refusal(solid), "");
}

// An arc whose end is computed may end a little outside.
TEST(Eye, MayBeTheEndOfTheProfile) {
  VaultSurface ends = vault(Profile::Kind::chain, 0.7);
  ends.profile.points = {{2.0, 0.7}, {0.0, 1.3}, {2.2}, {}};
  EXPECT_NEAR(make_surface(ends, 4).intrados(4, 0.0).x(), 0.7, 1e-15);
}

// A horseshoe of 80 degrees springs at r = 0.35 m and is widest at 2 m, above that.
TEST(Eye, OfAHorseshoeMayBeWiderThanItsSpringing) {
  for (const double eye : {0.1, 1.0, 1.998}) {
    VaultSurface horseshoe = vault(Profile::Kind::horseshoe, eye);
    horseshoe.profile.below_deg = 80.0;
    horseshoe.thickness = 0.1;
    const SurfaceMap map = make_surface(horseshoe, 16);
    EXPECT_NEAR(map.intrados(16, 0.0).x(), eye, 1e-14) << "bisected to rounding";
    EXPECT_GT(map.intrados(16, 0.0).z(), 0.0);
  }
}

// A dome of 5 m drawn by its back is the same drawn by its intrados of 4.5 m: the eye of 0.4 m shrinks to 0.36
// m.
TEST(Eye, OfADrawnBackMayBeNarrowerThanTheThickness) {
  VaultSurface back = vault(Profile::Kind::semicircle, 0.4);
  back.profile.span = 10.0;
  back.thickness = 0.5;
  VaultSurface inside = back;
  inside.profile.span = 9.0;
  inside.eye = 0.36;
  back.line = VaultSurface::Line::extrados;
  const SurfaceMap a = make_surface(back, 8), b = make_surface(inside, 8);
  for (int bed = 0; bed <= 8; ++bed)
    for (const int layer : {0, 1})
      EXPECT_LT((a.point(bed, 0.3, layer) - b.point(bed, 0.3, layer)).norm(), 1e-14) << "rounding of 5 m";
}

// The normal of a pointed profile is inclined at the crown, so that a small eye is less than none inside.
TEST(Eye, LeavesTheIntradosOutsideTheAxis) {
  VaultSurface pointed = vault(Profile::Kind::pointed, 0.1);
  pointed.line = VaultSurface::Line::extrados;
  for (const auto beds : {VaultSurface::Beds::normal, VaultSurface::Beds::level}) {
    pointed.beds = beds;
    pointed.eye = beds == VaultSurface::Beds::normal ? 0.1 : 0.3;
    expect_part(refusal(pointed), "geometry.surface.eye: on the last bed the drawn line lies at");
  }
  pointed.eye = 1.0;
  EXPECT_EQ(refusal(pointed), "");
}

}  // namespace
}  // namespace cupola::eye_test
