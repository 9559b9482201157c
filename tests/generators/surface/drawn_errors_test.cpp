// Profiles carried along plans that are refused, and random ones, which are laid or refused.

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "generators/surface/make_surface.hpp"
#include "tests/generators/models.hpp"
#include "tests/generators/surface/drawn_vaults.hpp"

namespace cupola::drawn_errors_test {
namespace {

using Kind = Profile::Kind;
using test::case_of;
using test::chain_of;
using test::profile_of;
using test::vault_on;

std::string error_of(const VaultSurface& surface, int rings = 8) {
  try {
    generate(case_of(surface, rings));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DrawnErrors, NameTheKeyAndThePlace) {
  VaultSurface open = vault_on(Plan::Kind::circle, profile_of(Kind::semicircle));
  open.eye = 0.0;
  EXPECT_NE(error_of(open).find("geometry.surface.eye = 0: the profile reaches the axis at z = 5 m"),
            std::string::npos);
  EXPECT_NE(error_of(open).find("a solid tip on level beds is loads.lantern: {weight: N}"),
            std::string::npos);
  for (const Plan::Kind plan : {Plan::Kind::line, Plan::Kind::circle})
    EXPECT_NE(
        error_of(vault_on(plan, chain_of({1, 3, 4}, {4, 3, 0})))
            .find("profile: ends at (4, 0) m, lower and farther from the axis than it begins, at (1, 4) m"),
        std::string::npos)
        << error_of(vault_on(plan, chain_of({1, 3, 4}, {4, 3, 0})));
  VaultSurface level = vault_on(Plan::Kind::circle, profile_of(Kind::semicircle));
  level.eye = 1.0;
  level.key_stone = true;
  level.beds = VaultSurface::Beds::level;
  EXPECT_NE(error_of(level).find("give beds: normal, or leave out key_stone"), std::string::npos)
      << error_of(level);
  for (const Profile& profile : {profile_of(Kind::semicircle), chain_of({3, 2, -1, -2}, {0, 2, 2.5, 1})}) {
    VaultSurface barrel = vault_on(Plan::Kind::line, profile);
    barrel.beds = VaultSurface::Beds::level;
    for (const int rings : {8, 9})
      EXPECT_NE(error_of(barrel, rings).find("surface.beds = level: a stone between the level beds on both"),
                std::string::npos)
          << error_of(barrel, rings);
  }
  VaultSurface folds = vault_on(Plan::Kind::line, profile_of(Kind::semicircle, 1.0), 1.0);
  folds.line = VaultSurface::Line::extrados;
  EXPECT_NE(error_of(folds).find("has a radius of 0.5 m"), std::string::npos);
  EXPECT_NE(error_of(vault_on(Plan::Kind::line, chain_of({3, 3, 0}, {0, 0.1, 3})), 4).find("too few"),
            std::string::npos);
  EXPECT_NE(error_of(vault_on(Plan::Kind::line, profile_of(Kind::pointed)), 9).find("must be even"),
            std::string::npos);
  EXPECT_NE(error_of(vault_on(Plan::Kind::line, chain_of({3, 3, 3}, {0, 1, 1}))).find("points 1 and 2"),
            std::string::npos);
  EXPECT_NE(error_of(vault_on(Plan::Kind::line, chain_of({3, 3, 4, 2}, {0, 2, 1, 1})))
                .find("crosses itself at (3, 1) m, between the points 0 and 1 and the points 2 and 3"),
            std::string::npos);
  VaultSurface narrow = vault_on(Plan::Kind::corners, profile_of(Kind::semicircle, 20.0));
  EXPECT_NE(error_of(narrow).find("vanishes before the last bed"), std::string::npos);
}

// The profile ends at z = sqrt(25 - eye^2), its intrados at 4.5 m: at an eye of 2.2 m the last bed lies at
// 4.490 m, at 2.15 m at 4.514 m. 1e-12: rounding of the root.
TEST(DrawnErrors, LevelBedsMeetTheIntradosOrAreRefused) {
  VaultSurface level = vault_on(Plan::Kind::circle, profile_of(Kind::semicircle), 1.0);
  level.line = VaultSurface::Line::middle;
  level.beds = VaultSurface::Beds::level;
  level.eye = 2.2;
  EXPECT_NEAR(make_surface(level, 8).intrados(8, 0).x(), std::sqrt(4.5 * 4.5 - (25 - 2.2 * 2.2)), 1e-12);
  for (const double eye : {2.15, 2.05, 2.0, 1.9, 1.3}) {
    level.eye = eye;
    EXPECT_NE(error_of(level).find("geometry.surface.beds = level: the bed at z = 4."), std::string::npos)
        << eye << error_of(level);
  }
  level.plan.kind = Plan::Kind::polygon;
  level.eye = 2.0;
  EXPECT_NE(error_of(level).find("does not meet the intrados; choose a larger eye"), std::string::npos);
}

// Cones through a kink at the corners meet the sails above or below it.
TEST(DrawnErrors, ConicalBedsHaveNoKinks) {
  VaultSurface kinked = vault_on(Plan::Kind::polygon, chain_of({5, 5, 4, 4}, {0, 2, 3, 5}), 0.2);
  kinked.eye = 0.0;
  EXPECT_EQ(error_of(kinked, 24), "");
  kinked.beds = VaultSurface::Beds::conical;
  EXPECT_NE(error_of(kinked, 24).find("geometry.surface.beds = conical: the profile has a kink at (5, 2) m"),
            std::string::npos)
      << error_of(kinked, 24);
}

// An arc that turns away from the axis has its centre outside, so that the intrados has the larger radius.
TEST(DrawnErrors, OnlyArcsTowardsTheAxisFoldInside) {
  const auto ogee = [](double radius) {
    VaultSurface v = vault_on(
        Plan::Kind::circle, chain_of({6, 5, 4.882843, 4.882843}, {0, 1, 1.282843, 3.282843}, {0, radius, 0}));
    v.line = VaultSurface::Line::extrados;
    v.eye = 0.0;
    return v;
  };
  EXPECT_EQ(error_of(ogee(-0.4), 20), "");
  EXPECT_NE(error_of(ogee(0.4), 20).find("has a radius of 0.4 m"), std::string::npos);
}

// The least radius of the ellipse, 0.333 m, is at the crown; at the eye it is 10.1 m.
TEST(DrawnErrors, WhatTheEyeTakesAwayFoldsNothing) {
  VaultSurface slender = vault_on(Plan::Kind::circle, profile_of(Kind::ellipse, 4.0, 12.0), 0.8);
  slender.line = VaultSurface::Line::middle;
  EXPECT_EQ(error_of(slender), "");
}

// Whatever is drawn is laid without gaps and overlaps, or refused with its key.
void expect_laid_or_refused(int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  int laid = 0;
  for (int i = 0; i < count; ++i) {
    VaultSurface v = vault_on(static_cast<Plan::Kind>(random() % 5),
                              profile_of(static_cast<Kind>(random() % 9), between(4, 12), between(1, 7)),
                              between(0.2, 1.0));
    v.plan.sides = 3 + static_cast<int>(random() % 6);
    v.profile.haunch_radius = between(0.5, 3.0);
    v.profile.batter = between(-0.2, 0.2);
    v.line = static_cast<VaultSurface::Line>(random() % 3);
    if (v.plan.closed() && v.profile.kind != Kind::straight) v.eye = between(0.5, 2.0);
    if (v.plan.kind == Plan::Kind::polygon && random() % 2 == 0) v.beds = VaultSurface::Beds::conical;
    if (v.plan.kind == Plan::Kind::groin) v.eye = 0.0;
    if (v.plan.kind != Plan::Kind::groin && random() % 4 == 0) {
      v.beds = VaultSurface::Beds::given;
      v.bed_angles_deg = {between(-10.0, 30.0), between(30.0, 60.0), 90.0};
    }
    v.courses = static_cast<VaultSurface::Courses>(random() % 3);
    v.key_stone = v.plan.kind == Plan::Kind::circle && random() % 2 == 0;
    Case scene = case_of(v, 6, 8 + static_cast<int>(random() % 8));
    if (v.plan.kind == Plan::Kind::circle && random() % 2 == 0)
      scene.geometry.bond = DrawnBond{.rings = 6,
                                      .rows = {"cddc", "aabb"},
                                      .letter_length = between(0.2, 0.6),
                                      .length = DrawnBond::Length::constant};
    if (random() % 3 == 0) scene.geometry.affine = Affine{{between(0.7, 1.5), between(0.7, 1.5), 1.0}, 0.0};
    if (random() % 3 == 0) {
      Cut cut;
      cut.kind = random() % 2 == 0 ? Cut::Kind::plane : Cut::Kind::cylinder;
      if (cut.kind == Cut::Kind::plane) cut.as = static_cast<Cut::As>(random() % 3);
      cut.point = {between(0.0, 4.0), between(-2.0, 2.0), between(0.0, 3.0)};
      cut.normal = {1.0, between(-1.0, 1.0), between(-0.5, 0.5)};
      cut.axis = static_cast<Cut::Axis>(random() % 3);
      cut.centre_u = between(-3.0, 3.0);
      cut.centre_v = between(0.0, 4.0);
      cut.radius = between(0.2, 1.5);
      scene.geometry.cuts = {cut};
    }
    try {
      ModelReport report;
      check_and_report(scene, &report);
      EXPECT_TRUE(report.islands == 1 || !scene.geometry.cuts.empty()) << i;
      ++laid;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("geometry"), std::string::npos)
          << i << ": plan " << static_cast<int>(v.plan.kind) << " of " << v.plan.sides << ", profile "
          << static_cast<int>(v.profile.kind) << " of " << v.profile.span << " by " << v.profile.rise
          << ", beds " << static_cast<int>(v.beds) << ", courses " << static_cast<int>(v.courses) << ", line "
          << static_cast<int>(v.line) << ", thickness " << v.thickness << ", " << scene.geometry.cuts.size()
          << " cuts, affine " << scene.geometry.affine.has_value() << ": " << error.what();
    }
  }
  EXPECT_GT(laid, count / 2);
}

// Over a triangle the cones of the beds are twice as steep at mid-sail as at the corners, and meet inside a
// thick shell.
TEST(DrawnErrors, CoursesThatFoldAreRefusedWithTheirPlace) {
  VaultSurface v = vault_on(Plan::Kind::polygon, profile_of(Kind::ellipse, 9.5, 3.1), 0.8);
  v.plan.sides = 3;
  v.beds = VaultSurface::Beds::conical;
  v.line = VaultSurface::Line::middle;
  v.eye = 1.1;
  VaultSurface inside_out = vault_on(Plan::Kind::polygon, profile_of(Kind::basket, 12.0, 2.3), 0.9);
  inside_out.plan.sides = 3;  // both skins of a course turn back
  inside_out.profile.haunch_radius = 1.6;
  inside_out.beds = VaultSurface::Beds::conical;
  inside_out.courses = VaultSurface::Courses::height;
  inside_out.eye = 1.4;
  for (const VaultSurface& surface : {v, inside_out}) {
    try {
      generate(case_of(surface, 6, 9));
      ADD_FAILURE() << "laid";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("folds about ("), std::string::npos) << error.what();
    }
  }
}

TEST(DrawnErrors, RandomDrawingsAreLaidOrRefused) {
  expect_laid_or_refused(20, 7);
}
TEST(DrawnSlow, RandomDrawingsAreLaidOrRefused) {
  const char* seed = std::getenv("VAULT_SEED");  // of make random-vaults
  expect_laid_or_refused(500, seed ? static_cast<unsigned>(std::atoi(seed)) : 8);
}

}  // namespace
}  // namespace cupola::drawn_errors_test
