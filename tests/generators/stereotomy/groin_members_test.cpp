// What stands under and on a groin vault: springers, buttresses and ribs.

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "generators/surface/make_surface.hpp"
#include "tests/generators/models.hpp"

namespace cupola::groin_members_test {
namespace {

constexpr double kSpan = 6.0, kThick = 0.3;  // m

VaultSurface groin(int springers) {
  VaultSurface v;
  v.plan.kind = Plan::Kind::groin;
  v.plan.sides = 4;
  v.plan.springers = springers;
  v.profile.span = kSpan;
  v.thickness = kThick;
  return v;
}

Case vault(int springers, const Bond& bond = RunningBond{14, 6, 2}) {
  Case c;
  c.geometry.surface = groin(springers);
  c.geometry.bond = bond;
  return c;
}

double volume_of(const Case& c, ModelReport* report) {
  check_and_report(c, report);  // throws where blocks overlap
  EXPECT_LT(report->max_overlap, 2e-11 * kSpan);
  EXPECT_LT(report->max_joint_gap, 2e-11 * kSpan);
  return report->volume;
}

/// m3: what lies between the first beds and level ones. The section is a triangle with a right angle at the
/// back: a leg is the bed, inclined by `rise`, and the other one continues the extrados; at x it is 3 - x
/// long.
double wedges() {
  const double inner = 0.5 * kSpan, rise = std::acos((inner - 0.5 * kThick) / (inner + kThick));
  const double leg = kThick * std::tan(rise), area = 0.5 * kThick * leg;
  const double front = inner * std::cos(rise), back = (inner + kThick) * std::cos(rise);
  const double low = back + leg * std::sin(rise);
  return 8.0 * area * (inner - (front + back + low) / 3.0);
}

std::map<int, int> stones_per_course(const Assembly& assembly) {
  std::map<int, int> count;
  for (const Block& block : assembly.blocks) ++count[block.ring];
  return count;
}

TEST(Springers, AreOneStoneAtEachCornerOnALevelBed) {
  ModelReport without, with;
  const double added = volume_of(vault(3), &with) - volume_of(vault(0), &without);
  EXPECT_NEAR(added, wedges(), 1e-12 * without.volume);
  EXPECT_EQ(with.islands, 1);
  EXPECT_EQ(with.num_supports, 4);
  const Assembly assembly = generate(vault(3));
  const std::map<int, int> count = stones_per_course(assembly), plain = stones_per_course(generate(vault(0)));
  EXPECT_EQ(count.at(-1), 4);
  EXPECT_EQ(count.at(0), 4);
  EXPECT_EQ(count.count(1) + count.count(2), 0u);
  for (int course = 3; course < 7; ++course) EXPECT_EQ(count.at(course), plain.at(course));
  for (int f = 0; f < assembly.num_faces(); ++f) {  // of the supports, which look up
    if (assembly.face_kinds[f] != FaceKind::bed) continue;
    const Plane plane = polygon_plane(face_points(assembly, f));
    bool fixed = false;
    for (const Part& part : assembly.parts)
      fixed = fixed || (f >= part.face_start && f < part.face_start + part.num_faces &&
                        assembly.blocks[part.block].fixed);
    if (fixed) {
      EXPECT_NEAR(plane.normal.z(), 1.0, 1e-12);
    }
  }
}

// In wythes and in drawn bonds, over any number of corners, and stretched to a rectangle.
TEST(Springers, StandInEveryBond) {
  ModelReport report;
  Case triangle = vault(2);
  std::get<VaultSurface>(triangle.geometry.surface).plan.sides = 3;
  volume_of(triangle, &report);
  EXPECT_EQ(report.islands, 1);
  Case drawn = vault(2, DrawnBond{.rings = 21, .rows = {"xbby", "aaxy"}, .letter_length = 0.25, .shift = 2});
  drawn.geometry.affine = Affine{.scale = {1.0, 0.75, 1.0}};
  volume_of(drawn, &report);
  EXPECT_EQ(report.islands, 1);
  Case wythes = vault(2);
  wythes.geometry.wythes = {{"inner", {{}, {0.1}}, RunningBond{14, 6, 2}, {}},
                            {"outer", {{}, {0.2}}, RunningBond{14, 6, 2}, {}}};
  volume_of(wythes, &report);
  EXPECT_EQ(report.islands, 1);
}

/// The vault on four piers, whose inner ends lie `inside` m from the axis.
Case on_buttresses(double inside, int springers = 2) {
  Case c = vault(springers);
  Member pier;
  pier.name = "pier";
  const double half = 0.4, d = std::numbers::sqrt2 / 2.0;
  pier.at = Place{{d * (inside + half), d * (inside - half), 0.0}, 45.0};
  pier.copies.emplace().count = 4;
  pier.copies->about = Vec3::Zero();
  pier.surface = WallSurface{2.4, 3.0, 2.0 * half};
  pier.bond = RunningBond{6, 3, 2};
  c.geometry.members = {pier};
  c.geometry.on = "pier";
  return c;
}

TEST(GroinVault, StandsOnAllCopiesOfAMember) {
  ModelReport report, alone;
  const double own = volume_of(vault(2), &alone);
  EXPECT_NEAR(volume_of(on_buttresses(3.6), &report), own + 4 * 2.4 * 3.0 * 0.8, 1e-12 * own);
  EXPECT_EQ(report.islands, 1);
  EXPECT_EQ(report.num_supports, 4) << "those of the piers";
  const Assembly assembly = generate(on_buttresses(3.6));
  ASSERT_EQ(assembly.sheets.size(), 5u);
  EXPECT_EQ(assembly.sheets[4].first_ring, 4 * 6);
  EXPECT_FALSE(assembly.sheets[4].on_previous) << "a stack of its own";
}

// Two of the four piers are missing: the stones of the other corners hold the corners up in the model.
TEST(GroinVault, WarnsOfCornersOnNothing) {
  GenerateReport report;
  generate(on_buttresses(3.6), &report);
  EXPECT_TRUE(warnings_of(report).empty());
  Case half = on_buttresses(3.6);
  half.geometry.members[0].copies->count = 2;
  generate(half, &report);
  const std::vector<std::string> warnings = warnings_of(report);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("a corner of the member shell hangs in the air"), std::string::npos)
      << warnings[0];
}

TEST(GroinVaultErrors, OfSpringersAndButtressesNameTheKey) {
  EXPECT_NE(refusal_of(vault(7)).find("geometry.surface.plan.springers = 7: must be below 7"),
            std::string::npos)
      << refusal_of(vault(7));
  EXPECT_NE(refusal_of(on_buttresses(3.6, 0)).find("give plan.springers"), std::string::npos);
  for (const double inside : {4.3, 9.0})  // 0.1 m beside the springers, at their height, and far away
    EXPECT_NE(refusal_of(on_buttresses(inside)).find("a part of the member shell floats"), std::string::npos);
}

Member rib(double deg) {
  constexpr double kWidth = 0.3;
  VaultSurface arch;
  arch.plan.kind = Plan::Kind::line;
  arch.plan.length = kWidth;
  arch.profile.kind = Profile::Kind::ellipse;
  arch.profile.span = 7.8;
  arch.profile.rise = 2.7;
  arch.thickness = 0.6;
  Member member;
  member.name = deg == 45.0 ? "rib" : "other";
  const double angle = deg * std::numbers::pi / 180.0;
  member.at = Place{{0.5 * kWidth * std::sin(angle), -0.5 * kWidth * std::cos(angle), 0.0}, deg};
  member.surface = arch;
  member.bond = StackBond{17, 1, 1};
  Cut back;
  back.kind = Cut::Kind::over;
  back.member = "shell";
  member.cuts = {back};
  return member;
}

/// z of the intrados of a web of 14 courses at a distance from its axis, continued by its tangent.
double web_height(double x) {
  const double radius = 0.5 * kSpan, foot = std::acos((radius - 0.5 * kThick) / (radius + kThick));
  const double step = (std::numbers::pi - 2.0 * foot) / 14.0, angle = std::acos(std::min(x / radius, 1.0));
  if (x > radius * std::cos(foot))
    return radius * std::sin(foot) - (x - radius * std::cos(foot)) / std::tan(foot);
  const double low = foot + step * std::floor((angle - foot) / step), share = radius * std::cos(low) - x;
  const double run = radius * (std::cos(low) - std::cos(low + step));
  return radius * (std::sin(low) + share / run * (std::sin(low + step) - std::sin(low)));
}

/// m3, by points: of a rib between the sections of its arch and the webs of the vault.
double rib_by_points(const Member& member) {
  const SurfaceMap arch = make_surface(member.surface, 17);
  constexpr int n = 1200, layers = 6;
  constexpr double kReach = 4.8, kTop = 3.5, kDeep = 0.8;  // m
  const double area = 2.0 * kReach / n * (kTop + kDeep) / n;
  double sum = 0.0;
  for (int k = 0; k < 17; ++k) {
    std::vector<Vec3> quad{arch.intrados(k, 0.0), arch.extrados(k, 0.0), arch.extrados(k + 1, 0.0),
                           arch.intrados(k + 1, 0.0)};
    const auto inside = [&](double u, double z) {
      for (size_t i = 0; i < 4; ++i) {
        const Vec3 &a = quad[i], &b = quad[(i + 1) % 4];
        if ((b.x() - a.x()) * (z - a.z()) - (b.z() - a.z()) * (u - a.x()) < 0.0) return false;
      }
      return true;
    };
    double left = 1e9, right = -1e9;
    for (const Vec3& p : quad) left = std::min(left, p.x()), right = std::max(right, p.x());
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double u = -kReach + 2.0 * kReach * (i + 0.5) / n, z = -kDeep + (kTop + kDeep) * (j + 0.5) / n;
        if (u < left || u > right || !inside(u, z)) continue;
        for (int m = 0; m < layers; ++m) {
          const double v = 0.15 * (m + 0.5) / layers, d = std::numbers::sqrt2 / 2.0;
          const double across = std::min(std::abs(d * (u + v)), std::abs(d * (u - v)));
          if (z < web_height(across)) sum += area * 0.3 / layers;
        }
      }
  }
  return sum;
}

// Points on 1200 x 1200 x 6 places of a section 0.3 m deep: 1 in 3000.
TEST(Ribs, FillTheSpaceUnderTheWebs) {
  ModelReport alone, ribbed;
  Case c = vault(0);
  const double own = volume_of(c, &alone);
  c.geometry.members = {rib(45.0)};
  const double added = volume_of(c, &ribbed) - own, expected = rib_by_points(rib(45.0));
  EXPECT_NEAR(added / expected, 1.0, 1e-3);
  EXPECT_EQ(ribbed.islands, 1) << "the backs touch the webs";
  EXPECT_EQ(ribbed.num_blocks, alone.num_blocks + 17) << "stones of a rib stay whole";
}

TEST(Ribs, LeanOnEachOtherInHalves) {
  Case c = vault(0);
  Member other = rib(135.0);
  Cut middle;
  middle.kind = Cut::Kind::prism;
  middle.axis = Cut::Axis::z;
  middle.u = {-0.15, 0.15, 0.15, -0.15};
  middle.v = {-1.0, -1.0, 1.0, 1.0};
  other.cuts.push_back(middle);
  c.geometry.members = {rib(45.0), other};
  ModelReport report;
  volume_of(c, &report);
  EXPECT_EQ(report.islands, 1);
}

TEST(Ribs, RequireAGroinVault) {
  Case c = vault(0);
  c.geometry.members = {rib(45.0)};
  c.geometry.members[0].cuts[0].member = "nave";
  EXPECT_NE(
      refusal_of(c).find("geometry.members[0].cuts[0].member = nave: must be another member, over a plan of "
                         "type groin"),
      std::string::npos)
      << refusal_of(c);
}

}  // namespace
}  // namespace cupola::groin_members_test
