// Drums: volume against closed forms, openings and lintels, the base in several blocks, and what is refused.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/bond_map.hpp"
#include "generators/stereotomy/opening_places.hpp"
#include "generators/surface/make_surface.hpp"
#include "tests/generators/models.hpp"

namespace cupola::drum_test {
namespace {

using std::numbers::pi;
using Construction = OctagonalVault::Construction;

constexpr double kSpan = 10.0, kHeight = 3.0, kThickness = 1.0;  // m
constexpr double kApothem = 0.5 * kSpan * 0.9238795325112867;    // m, times cos(pi / 8)

Openings openings(double width, double height, double sill) {
  Openings group;
  group.width = width;
  group.height = height;
  group.sill = sill;
  group.bearing = 0.4;
  return group;
}

/// Octagonal vault of 10 m on a drum of six courses.
Case vault_on_drum(Construction construction = Construction::circular) {
  Case c;
  OctagonalVault vault;
  vault.span = kSpan;
  vault.thickness = 0.6;
  vault.construction = construction;
  c.geometry.surface = vault;
  c.geometry.bond = RunningBond{8, 24, 2};
  const bool cones = construction == Construction::circular;
  c.geometry.members = {octagonal_drum(kSpan, kHeight, kThickness, RunningBond{6, 24, 2},
                                       cones ? VaultSurface::Beds::conical : VaultSurface::Beds::normal)};
  c.geometry.on = "drum";
  return c;
}

Case with_windows(const Openings& group) {
  Case c = vault_on_drum();
  c.geometry.members[0].openings = {group};
  return c;
}

/// m2, between two parallel lines at the distances a and a + t from the axis, and two planes through the axis
/// that cut the nearer line at a distance `width`.
double area_between(double width, double a, double t) {
  return 0.5 * width / a * ((a + t) * (a + t) - a * a);
}

/// m3, of the octagonal wall without openings.
double wall_volume() {
  return kHeight * 8.0 * area_between(2.0 * kApothem * std::tan(pi / 8.0), kApothem, kThickness);
}

/// m3 of all blocks whose member begins with `prefix`.
double volume_of(const Assembly& assembly, const std::string& prefix) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed && assembly.members[block.member].starts_with(prefix)) sum += block.volume;
  return sum;
}

int count(const Assembly& assembly, const std::string& member) {
  return static_cast<int>(std::ranges::count_if(assembly.blocks, [&](const Block& block) {
    return !block.fixed && assembly.members[block.member] == member;
  }));
}

void expect_sound(const Case& c, Assembly* assembly) {
  ModelReport report;
  *assembly = check_and_report(c, &report);
  EXPECT_LT(report.max_convexity_error, 1e-14);  // 20 m times the rounding error of a few operations
  EXPECT_LT(report.max_planarity_error, 1e-14);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_LT(report.max_joint_gap, 1e-14);
  EXPECT_EQ(report.islands, 1);
  EXPECT_TRUE(report.blocks_without_joint.empty());
  EXPECT_TRUE(report.narrow_joints.empty());
  EXPECT_NEAR(report.parts_volume, report.volume, 1e-12 * report.volume);
}

constexpr double kSums = 1e-13;  // relative, rounding of sums of a few hundred volumes

class DrumOf : public testing::TestWithParam<Construction> {};

TEST_P(DrumOf, FillsAPrismBelowTheSpringing) {
  const Case c = vault_on_drum(GetParam());
  Assembly assembly;
  expect_sound(c, &assembly);
  EXPECT_EQ(assembly.members, (std::vector<std::string>{"drum", "shell"}));
  EXPECT_EQ(count(assembly, "drum"), 6 * 24);
  EXPECT_NEAR(volume_of(assembly, "drum") / wall_volume(), 1.0, kSums);
  Case shell = c;
  shell.geometry.members.clear();
  shell.geometry.on.clear();
  const Assembly alone = cut_assembly(shell);
  double volume = 0.0;
  for (const Block& block : alone.blocks) volume += block.fixed ? 0.0 : block.volume;
  EXPECT_NEAR(volume_of(assembly, "shell") / volume, 1.0, kSums);
  EXPECT_EQ(assembly.num_rings, 6 + 8);
  for (const Block& block : assembly.blocks) EXPECT_EQ(block.ring < 6, block.centroid.z() < 0.0);
}

INSTANTIATE_TEST_SUITE_P(Vaults, DrumOf,
                         testing::Values(Construction::circular, Construction::planar_radial,
                                         Construction::planar_horizontal),
                         [](const auto& param_info) { return std::string(to_string(param_info.param)); });

// The wall of a round dome is a prism over the polygon of its slices.
TEST(Drum, OfADomeIsAPolygonalRing) {
  Case c = vault_on_drum();
  DomeSurface dome;
  dome.span = kSpan;
  dome.thickness = 0.6;
  c.geometry.surface = dome;
  std::get<VaultSurface>(c.geometry.members[0].surface).plan.kind = Plan::Kind::circle;
  std::get<VaultSurface>(c.geometry.members[0].surface).beds = VaultSurface::Beds::normal;
  Assembly assembly;
  expect_sound(c, &assembly);
  const double outer = 0.5 * kSpan + kThickness, inner = 0.5 * kSpan;
  const double polygon = 0.5 * 48 * std::sin(2.0 * pi / 48) * (outer * outer - inner * inner);
  EXPECT_NEAR(volume_of(assembly, "drum") / (polygon * kHeight), 1.0, kSums);
}

// Jambs are radial planes, so that a window is a trapezoid in plan.
TEST(Drum, LacksItsOpenings) {
  const Case c = with_windows(openings(1.2, 1.0, 1.0));
  Assembly assembly;
  expect_sound(c, &assembly);
  const double window = 1.0 * area_between(1.2, kApothem, kThickness);
  EXPECT_NEAR(volume_of(assembly, "drum") / (wall_volume() - 8.0 * window), 1.0, kSums);
  ASSERT_EQ(count(assembly, "drum lintel"), 8);
  const double lintel = 0.5 * area_between(1.2 + 2 * 0.4, kApothem, kThickness);
  EXPECT_NEAR(volume_of(assembly, "drum lintel") / (8.0 * lintel), 1.0, kSums);
}

// In a wall that leans the radial jambs approach each other, or part; the lintel rests on 0.4 m beside them
// all the same. 1e-12: rounding of bisected angles.
TEST(Drum, LintelsRestOnTheirBearingInWallsThatLean) {
  for (const double batter : {0.4, -0.4, 0.0}) {
    VaultSurface wall;
    wall.plan.kind = Plan::Kind::circle;
    wall.profile.kind = Profile::Kind::straight;
    wall.profile.span = kSpan;
    wall.profile.height = kHeight;
    wall.profile.batter = batter;
    wall.thickness = 0.6;
    wall.beds = VaultSurface::Beds::level;
    Openings group = openings(1.2, 1.5, 0.5);
    group.per_ring = 4;
    const SurfaceMap map = make_surface(wall, 6);
    const OpeningPlace place = opening_places({group}, map, "openings").front();
    const auto chord = [&](int bed, double half) {
      return (map.intrados(bed, place.middle + half) - map.intrados(bed, place.middle - half)).norm();
    };
    EXPECT_NEAR(chord(1, place.half_opening), 1.2, 1e-12);
    EXPECT_NEAR(chord(4, place.half_lintel) - chord(4, place.half_opening), 2 * 0.4, 1e-12) << batter;
  }
}

TEST(Drum, SillsCountFromItsFirstBed) {
  VaultSurface wall;
  wall.profile.kind = Profile::Kind::chain;
  wall.profile.points = {{5.0, 5.0}, {3.0, 7.0}, {0.0, 0.0}, {}};
  wall.thickness = 0.6;
  Openings group = openings(1.0, 1.0, 1.0);
  group.per_ring = 4;
  EXPECT_EQ(opening_places({group}, make_surface(wall, 8), "openings").front().first_ring, 2);
}

TEST(Drum, HasAnOpeningWhereItIsPlaced) {
  Openings group = openings(1.0, 0.5, 1.5);
  group.per_ring = 4;
  group.at = {0.25};  // middle of the first side, and of every second one
  group.lintel = 1.0;
  const Case c = with_windows(group);
  Assembly assembly;
  expect_sound(c, &assembly);
  ASSERT_EQ(count(assembly, "drum lintel"), 4);
  for (const Block& block : assembly.blocks) {
    if (block.fixed || assembly.members[block.member] != "drum lintel") continue;
    const double side = (std::atan2(block.centroid.y(), block.centroid.x()) - pi / 8) / (pi / 2);
    EXPECT_NEAR(side, std::round(side), 1e-14);
    EXPECT_NEAR(block.centroid.z(), -kHeight + 1.5 + 0.5 + 0.5 * 1.0, 1e-14);
    EXPECT_EQ(block.num_rings, 2);
  }
}

// A narrow opening on a wide one: the lintel of the wide one becomes two corbels, and only the upper lintel
// is whole.
TEST(Drum, StepsOpeningsThatStandOnEachOther) {
  Case c = with_windows(openings(1.6, 1.0, 0.5));
  c.geometry.members[0].openings.push_back(openings(0.8, 1.5, 0.5));
  Assembly assembly;
  expect_sound(c, &assembly);
  const double missing =
      1.0 * area_between(1.6, kApothem, kThickness) + 0.5 * area_between(0.8, kApothem, kThickness);
  EXPECT_NEAR(volume_of(assembly, "drum") / (wall_volume() - 8.0 * missing), 1.0, kSums);
  EXPECT_EQ(count(assembly, "drum lintel"), 3 * 8);
}

TEST(Drum, HasWythesOfItsOwn) {
  Case c = with_windows(openings(1.2, 1.0, 1.0));
  Member& drum = c.geometry.members[0];
  const RunningBond bond{6, 24, 2};
  drum.wythes = {{"inner", {{}, {0.4}}, bond, {}}, {"outer", {{0.0, kHeight}, {0.8, 0.6}}, bond, {}}};
  drum.bonders.emplace_back();
  drum.bonders[0].name = "header";
  drum.bonders[0].from = "inner";
  drum.bonders[0].to = "outer";
  drum.bonders[0].per_ring = 24;
  drum.bonders[0].at = {0.25};
  drum.bonders[0].every = 3;
  Assembly assembly;
  expect_sound(c, &assembly);
  EXPECT_EQ(assembly.members,
            (std::vector<std::string>{"drum inner", "drum outer", "drum header", "drum lintel", "shell"}));
  for (const std::string& member : assembly.members) EXPECT_GT(count(assembly, member), 0) << member;
  // The thickness is 1.2 m at the foot and 1 m at the springing, so that the wall is a frustum less a prism.
  const double side = 2.0 * std::tan(pi / 8.0), foot = kApothem + 1.2, top = kApothem + 1.0;
  const auto volume = [&](double z0, double z1, double width) {  // of a trapezoid, `width` at a distance 1
    const auto outer = [&](double z) { return foot + (top - foot) * z / kHeight; };
    const double a = outer(z0), b = outer(z1);
    return 0.5 * width * (z1 - z0) * ((a * a + a * b + b * b) / 3.0 - kApothem * kApothem);
  };
  const double expected = 8.0 * (volume(0.0, kHeight, side) - volume(1.0, 2.0, 1.2 / kApothem));
  EXPECT_NEAR(volume_of(assembly, "drum") / expected, 1.0, kSums);
}

TEST(Drum, HasImperfectJoints) {
  Case c = vault_on_drum();
  c.geometry.imperfections = Imperfections{1e-4, 1e-3, 1};
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);  // throws if anything overlaps
  EXPECT_EQ(count(assembly, "drum"), 6 * 24);
}

// The stage counts the courses above the springing.
TEST(Drum, IsCompleteInEveryStage) {
  Case c = vault_on_drum();
  c.geometry.stage = Stage{2};
  const Assembly assembly = cut_assembly(c);
  EXPECT_EQ(count(assembly, "drum"), 6 * 24);
  EXPECT_EQ(count(assembly, "shell"), 2 * 24);
}

TEST(Base, IsDividedIntoBlocksAboutTheCorners) {
  Case c = vault_on_drum();
  double whole = 0.0;
  for (const Block& block : cut_assembly(c).blocks) whole += block.fixed ? block.volume : 0.0;
  c.geometry.base_blocks = 8;
  Assembly assembly;
  expect_sound(c, &assembly);
  double sum = 0.0;
  for (int b = 0; b < 8; ++b) {
    const Block& block = assembly.blocks[b];
    ASSERT_TRUE(block.fixed);
    sum += block.volume;
    const double azimuth = std::atan2(block.centroid.y(), block.centroid.x());
    EXPECT_NEAR(std::remainder(azimuth - b * pi / 4, 2.0 * pi), 0.0, 1e-14);
    EXPECT_LT(block.centroid.z(), -kHeight);
  }
  EXPECT_FALSE(assembly.blocks[8].fixed);
  // The cells at the boundaries cut the corners of the plan a little less.
  EXPECT_NEAR(sum / whole, 1.0, 1e-3);
}

/// A shell over a rectangle, of courses of 32 stones.
Case over_a_rectangle(double length, double width, Profile::Kind profile, double thickness) {
  VaultSurface hall;
  hall.plan.kind = Plan::Kind::corners;
  hall.plan.x = {length / 2, -length / 2, -length / 2, length / 2};
  hall.plan.y = {width / 2, width / 2, -width / 2, -width / 2};
  hall.profile.kind = profile;
  hall.profile.span = width;
  hall.profile.rise = 0.375 * width;
  hall.profile.height = width;
  hall.thickness = thickness;
  if (profile != Profile::Kind::straight) hall.eye = 0.1 * width;
  Case c;
  c.geometry.surface = hall;
  c.geometry.bond = RunningBond{4, 32, 2};
  return c;
}

// The outer corners of a bed over unequal sides do not lie on the rays from the axis through the inner ones.
TEST(Base, BearsTheWholeFirstBedOverUnequalSides) {
  for (const double width : {0.02, 1.0, 50.0}) {
    Case c = over_a_rectangle(12.0, 2.0, Profile::Kind::straight, 0.6);
    c.geometry.support_width = width;
    const Assembly assembly = generate(c);
    const auto lies_in = [&](const Part& part, const Vec3& point) {
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
        const Plane side = polygon_plane(face_points(assembly, f));
        if (side.normal.dot(point) - side.offset > 1e-12) return false;  // m, rounding of 50 m
      }
      return assembly.blocks[part.block].fixed;
    };
    for (const Vec3& corner : assembly.vertices)
      EXPECT_TRUE(
          corner.z() != 0.0 ||
          std::ranges::any_of(assembly.parts, [&](const Part& part) { return lies_in(part, corner); }))
          << width << " m: " << corner.transpose();
  }
}

// On an inclined first bed; the inner edge comes near to the middle of the hall.
TEST(Base, ReachesInwardsByOneDistance) {
  Case small = over_a_rectangle(0.4, 0.08, Profile::Kind::segmental, 0.008),
       wide = over_a_rectangle(20.0, 4.0, Profile::Kind::segmental, 0.4);
  wide.geometry.support_width = 20.0;
  EXPECT_NO_THROW(generate(small));
  EXPECT_NO_THROW(generate(wide));
}

TEST(Drum, IsDrawnBelowTheShell) {
  const std::string map = bond_map_svg(with_windows(openings(1.2, 1.0, 1.0)).geometry);
  EXPECT_NE(map.find(">drum<"), std::string::npos);
  EXPECT_NE(map.find(">shell<"), std::string::npos);
}

std::string message_of(const Case& c) {
  try {
    cut_assembly(c);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Drum, RefusesOpeningsWithoutRoomForTheirLintels) {
  const std::string corner = message_of(with_windows(openings(3.2, 1.0, 1.0)));
  EXPECT_NE(
      corner.find("geometry.members[0].openings[0].width = 3.2: with a bearing of 0.4 m on each side the "
                  "lintel is 4 m long, but there are only 3.82683 m"),
      std::string::npos)
      << corner;
  EXPECT_EQ(message_of(with_windows(openings(3.0, 1.0, 1.0))), "");  // 3.8 m
  Openings close = openings(1.2, 1.0, 1.0);
  close.at = {0.3, 0.7};  // 1.53 m apart
  EXPECT_NE(message_of(with_windows(close)).find("the next opening"), std::string::npos);
  close.at = {0.3};
  Case beside = with_windows(close);
  close.at = {0.7};
  beside.geometry.members[0].openings.push_back(close);
  EXPECT_NE(message_of(beside).find("geometry.members[0].openings[1]: "), std::string::npos);
  Case round = with_windows(openings(1.2, 1.0, 1.0));
  round.geometry.surface = DomeSurface{kSpan, 0.8, 0.6};
  std::get<VaultSurface>(round.geometry.members[0].surface).plan.kind = Plan::Kind::circle;
  std::get<VaultSurface>(round.geometry.members[0].surface).beds = VaultSurface::Beds::normal;
  EXPECT_NE(message_of(round).find("a round plan has no sides"), std::string::npos);
}

TEST(Drum, SaysThatItsOwnBondDoesNotFit) {
  Case c = vault_on_drum();
  HerringboneBond bond;
  bond.rings = 6;
  bond.blocks_per_ring = 3;
  c.geometry.members[0].bond = bond;
  const std::string message = message_of(c);
  EXPECT_TRUE(message.starts_with("error: geometry.members[0].bond.spirals = 8: ")) << message;
}

}  // namespace
}  // namespace cupola::drum_test
