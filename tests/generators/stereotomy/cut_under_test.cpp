// Walls cut under barrels that rake and lean, and the barrels under which nothing can be cut.

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "tests/generators/models.hpp"

namespace cupola::cut_under_test {
namespace {

constexpr double kRadius = 1.3, kThick = 0.5, kFoot = 0.5, kLong = 2.0;  // m

Member barrel(Profile::Kind profile) {
  VaultSurface surface;
  surface.plan.kind = Plan::Kind::line;
  surface.plan.length = kLong;
  surface.profile.kind = profile;
  surface.profile.span = 2.0;
  surface.thickness = kRadius - 1.0;
  Member member;
  member.name = "barrel";
  member.surface = surface;
  member.bond = RunningBond{8, 2, 2};
  return member;
}

/// A wall along the crown of the barrel, 0.5 m thick, from 2 m before it up to y = `end`. The map moves the
/// places of both as it does their points.
Case wall_over_barrel(double end, const Affine& affine) {
  Member below = barrel(Profile::Kind::semicircle), wall = barrel(Profile::Kind::straight);
  below.at = Place{affine.image({0.0, 0.0, kFoot}), 0.0};
  auto& surface = std::get<VaultSurface>(wall.surface);
  surface.plan.length = end + 2.0;
  surface.profile.height = 5.0;
  surface.thickness = kThick;
  wall.name = "wall";
  wall.at = Place{affine.image({-1.0 - kThick / 2, -2.0, 0.0}), 0.0};  // its inner face is at x = 1 m
  wall.bond = RunningBond{10, static_cast<int>(end) + 2, 2};
  wall.cuts.resize(1);
  wall.cuts[0].kind = Cut::Kind::under;
  wall.cuts[0].member = "barrel";
  Case c;
  c.geometry.members = {below, wall};
  c.geometry.has_shell = false;
  c.geometry.affine = affine;
  return c;
}

/// m3, of the wall and its copies that is left.
double wall_left(const Case& c) {
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_EQ(report.islands, 1);
  double volume = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed && assembly.sheet_of(block.ring)->name.starts_with("wall")) volume += block.volume;
  return volume;
}

// The end sections of a barrel that rakes stay vertical, those of one that leans do not. The whole scene is
// sheared, which changes no volume. With 8 courses, the crown is a ridge between facets of 22.5 degrees.
TEST(CutUnder, IsShearedAsTheBarrel) {
  const double section = kThick * (kFoot + kRadius) - kThick * kThick / 4 * std::tan(std::numbers::pi / 16);
  for (const double end : {1.0, 4.0})
    for (const Affine& affine : {Affine{}, Affine{.rake = 0.2}, Affine{.rake = 0.5}, Affine{.lean = 0.3},
                                 Affine{.rake = 0.3, .lean = -0.4}})
      EXPECT_NEAR(wall_left(wall_over_barrel(end, affine)),
                  kThick * 5.0 * (end + 2.0) - section * std::min(end, kLong), 1e-12)
          << "end " << end << ", rake " << affine.rake << ", lean " << affine.lean;
}

// The image of the wall, from y = 1.5 to 4.5 m, reaches over 0.5 m of the barrel, the wall over 1 m. The error
// of a copy beside the barrel named coordinates, which this cut does not have. Tolerance as above.
TEST(CutUnder, TakesFromEachCopyWhatLiesUnderIt) {
  const double section = kThick * (kFoot + kRadius) - kThick * kThick / 4 * std::tan(std::numbers::pi / 16);
  Case c = wall_over_barrel(1.0, {});
  c.geometry.members[1].mirror = Mirror{{0.0, 1.25, 0.0}, Vec3::UnitY()};
  EXPECT_NEAR(wall_left(c), 2.0 * kThick * 5.0 * 3.0 - 1.5 * section, 1e-12);
  c.geometry.members[1].mirror->point.y() = 2.0;
  EXPECT_NE(refusal_of(c).find("geometry.members[1].cuts[0]: the cut takes nothing; the member or a copy of "
                               "it lies beside barrel"),
            std::string::npos)
      << refusal_of(c);
}

TEST(CutUnder, RequiresASectionThatStaysBetweenItsSpringings) {
  Case c = wall_over_barrel(4.0, {});
  c.geometry.members[0].surface = barrel(Profile::Kind::horseshoe).surface;
  std::string text = refusal_of(c);
  EXPECT_NE(
      text.find("geometry.members[1].cuts[0].member = barrel: its section reaches beyond its springings"),
      std::string::npos)
      << text;
  c.geometry.members[0].surface = WallSurface{.length = 4.0, .height = 1.0, .thickness = 0.5};
  text = refusal_of(c);
  EXPECT_NE(text.find("geometry.members[1].cuts[0].member = barrel: spans nothing"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace cupola::cut_under_test
