// Several members: on each other, beside each other, and what is refused.

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/model/applied_loads.hpp"
#include "assembly/model/block_region.hpp"
#include "tests/generators/models.hpp"

namespace cupola::members_test {
namespace {

Member tower(const std::string& name, double span) {
  VaultSurface wall;
  wall.profile.kind = Profile::Kind::straight;
  wall.profile.span = span;
  wall.profile.height = 4.0;
  wall.thickness = 1.0;
  Member member;
  member.name = name;
  member.surface = wall;
  member.bond = RunningBond{4, 16, 2};
  return member;
}

Case members_case(std::vector<Member> members) {
  Case c;
  c.geometry.members = std::move(members);
  c.geometry.has_shell = false;
  return c;
}

TEST(Members, StandOnEachOther) {
  Member low = tower("low", 10.0), high = tower("high", 10.4);
  low.at = Place{{3.0, -2.0, 5.0}, 20.0};
  high.on = "low";
  high.bond = RunningBond{3, 11, 2};  // joints that do not match
  ModelReport report;
  const Assembly assembly = check_and_report(members_case({low, high}), &report);
  EXPECT_EQ(report.islands, 1);
  EXPECT_EQ(report.num_supports, 1);
  EXPECT_LT(report.max_joint_gap, 1e-14);
  ASSERT_EQ(assembly.sheets.size(), 2u);
  EXPECT_FALSE(assembly.sheets[0].on_previous);
  EXPECT_TRUE(assembly.sheets[1].on_previous);
  EXPECT_EQ(assembly.stack_of(6), std::pair(0, 7));
  EXPECT_LT((assembly.sheets[1].origin - Vec3(3.0, -2.0, 9.0)).norm(), 1e-14);
  EXPECT_NEAR(assembly.sheets[1].turn, 20.0 * std::numbers::pi / 180.0, 1e-15);
  for (const Block& block : assembly.blocks)
    EXPECT_EQ(block.centroid.z() > 9.0, block.ring >= 4) << "the upper one begins at 5 + 4 m";
}

// A motion of the whole changes no volume and no number.
TEST(Members, MayStandAnywhere) {
  Member moved = tower("moved", 10.0);
  const Case at_origin = members_case({moved});
  moved.at = Place{{100.0, 50.0, -3.0}, 33.0};
  ModelReport here, there;
  const Assembly a = check_and_report(at_origin, &here), b = check_and_report(members_case({moved}), &there);
  EXPECT_EQ(here.num_joints, there.num_joints);
  EXPECT_NEAR(here.volume / there.volume, 1.0, 1e-13);  // rounding of coordinates of 100 m
  const Vec3 moved_first =
      Eigen::AngleAxisd(33.0 * std::numbers::pi / 180.0, Vec3::UnitZ()) * a.blocks.back().centroid +
      Vec3(100.0, 50.0, -3.0);
  EXPECT_LT((b.blocks.back().centroid - moved_first).norm(), 1e-12);
}

// A barrel whose plane of symmetry is that of the mirror of a wall stands on the wall and on its image,
// without supports of its own: its outward direction is that of its own axis.
TEST(Members, ABarrelStandsOnAWallAndItsMirrorImage) {
  Member wall = tower("wall", 6.0);
  auto& low = std::get<VaultSurface>(wall.surface);
  low.plan.kind = Plan::Kind::line;
  low.plan.length = 5.0;
  wall.bond = RunningBond{4, 3, 2};
  wall.at = Place{{20.0, 3.0, 1.0}, 30.0};
  const Vec3 across = Eigen::AngleAxisd(std::numbers::pi / 6.0, Vec3::UnitZ()) * Vec3::UnitX();
  wall.mirror = Mirror{Vec3(20.0, 3.0, 0.0), across};
  Member barrel = wall;
  barrel.name = "barrel";
  barrel.on = "wall";
  barrel.at.reset();
  barrel.mirror.reset();
  auto& vault = std::get<VaultSurface>(barrel.surface);
  vault.profile.kind = Profile::Kind::segmental;
  vault.profile.rise = 1.5;
  vault.thickness = 0.4;
  vault.beds = VaultSurface::Beds::given;
  vault.bed_angles_deg = {0.0, 90.0};
  barrel.bond = RunningBond{11, 3, 2};
  ModelReport report;
  const Assembly assembly = check_and_report(members_case({wall, barrel}), &report);
  EXPECT_EQ(report.islands, 1);
  EXPECT_EQ(report.num_supports, 2) << "of the walls";
  ASSERT_EQ(assembly.sheets.size(), 3u);
  EXPECT_EQ(assembly.sheets[2].name, "barrel");
  EXPECT_FALSE(assembly.sheets[2].on_previous);
  EXPECT_LT((assembly.outward(8, Vec3(20.0, 3.0, 5.0) + across) - across).norm(), 1e-14);
  // Beside the mirror's plane each wall bears a barrel of its own, with a support behind its other springing.
  wall.mirror->point += 10.0 * across;
  check_and_report(members_case({wall, barrel}), &report);
  EXPECT_EQ(report.num_supports, 4);
  vault.beds = VaultSurface::Beds::normal;
  vault.bed_angles_deg.clear();
  wall.mirror->point -= 10.0 * across;
  try {
    check_and_report(members_case({wall, barrel}), &report);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the first bed of barrel is not level"), std::string::npos)
        << error.what();
  }
}

TEST(Members, SideBySideAreStacksOfTheirOwn) {
  Member east = tower("east", 6.0), west = tower("west", 6.0);
  west.at = Place{{-11.0, 0.0, 0.0}, 0.0};
  ModelReport report;
  const Assembly assembly = check_and_report(members_case({east, west}), &report);
  EXPECT_EQ(report.islands, 2);
  EXPECT_EQ(assembly.stack_of(3), std::pair(0, 4));
  EXPECT_EQ(assembly.stack_of(4), std::pair(4, 8));
  EXPECT_LT((assembly.outward(5, Vec3(-14.0, 0.0, 1.0)) + Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((assembly.outward(1, Vec3(3.0, 0.0, 1.0)) - Vec3::UnitX()).norm(), 1e-15);
}

// Outwards of a wall is that of the barrel on it, of a wall alone behind all of them that of the barrel before
// it. A barrel that is listed elsewhere, turned by 90 degrees, would give the direction along the wall.
TEST(Members, WallsPushAsTheBarrelsOnThem) {
  Assembly assembly;
  const auto list = [&](const Sheet& sheet) {
    assembly.sheets.push_back(sheet);
    assembly.sheets.back().first_ring = assembly.num_rings++;
    assembly.sheets.back().num_rings = 1;
  };
  const Sheet wall;
  Sheet barrel, turned;
  turned.thrust_lines = barrel.thrust_lines = Sheet::ThrustLines::one;
  turned.turn = std::numbers::pi / 2.0;
  for (const Sheet& sheet : {wall, wall, barrel, wall, wall, turned, wall}) list(sheet);
  const Vec3 point(2.0, 3.0, 1.0), x = Vec3::UnitX(), y = Vec3::UnitY();
  const std::array<Vec3, 7> outward = {x, x, x, y, y, y, y};
  for (int ring = 0; ring < 7; ++ring)
    EXPECT_LT((assembly.outward(ring, point) - outward.at(ring)).norm(), 1e-15)
        << ring;  // rounding of pi / 2
  EXPECT_EQ(assembly.vault_of(-1), &assembly.sheets[5]);
  assembly.sheets.resize(2);  // walls without a barrel
  EXPECT_TRUE(assembly.outward(0, point).array().isNaN().all());
}

// A pier and what stands on it, four times round a point; a row of three.
TEST(Members, HaveCopies) {
  Member pier = tower("pier", 3.0), top = tower("top", 3.2);
  pier.at = Place{{6.0, 0.0, 0.0}, 0.0};
  top.on = "pier";
  ModelReport one, four, row;
  check_and_report(members_case({pier, top}), &one);
  pier.copies = Copies{.count = 4, .about = Vec3(-3.0, 0.0, 0.0)};
  const Assembly assembly = check_and_report(members_case({pier, top}), &four);
  EXPECT_NEAR(four.volume / one.volume, 4.0, 1e-13);
  EXPECT_EQ(four.num_joints, 4 * one.num_joints);
  EXPECT_EQ(four.islands, 4);
  ASSERT_EQ(assembly.sheets.size(), 8u);
  EXPECT_EQ(assembly.sheets[2].name, "pier 2");
  EXPECT_EQ(assembly.sheets[3].name, "top 2");
  EXPECT_TRUE(assembly.sheets[3].on_previous);
  EXPECT_EQ(assembly.sheets[2].first_ring, 8);
  EXPECT_LT((assembly.sheets[4].origin - Vec3(-12.0, 0.0, 0.0)).norm(), 1e-14) << "half round";
  EXPECT_EQ(assembly.members, (std::vector<std::string>{"pier", "top", "pier 2", "top 2", "pier 3", "top 3",
                                                        "pier 4", "top 4"}));
  // The name of a member means its copies, too; that of a copy means it alone.
  const auto loaded = [&](const std::string& member, FaceKind kind) {
    Loads loads;
    FaceLoad& load = loads.faces.emplace_back();
    load.faces = kind;
    load.member = member;
    load.traction = Vec3(0.0, 0.0, -1e3);
    double sum = 0.0;
    for (const PointForce& force : applied_loads(loads, assembly)) sum -= force.force.z();
    return sum;
  };
  EXPECT_GT(loaded("pier 3", FaceKind::extrados), 0.0);
  for (const FaceKind kind : {FaceKind::extrados, FaceKind::top}) {
    const char* member = kind == FaceKind::top ? "top" : "pier";
    EXPECT_NEAR(loaded(member, kind), 4.0 * loaded(member + std::string(" 3"), kind), 1e-8) << "rounding, N";
  }
  EXPECT_EQ(blocks_of_region({.member = "pier"}, assembly, true, "key").size(), 4u);
  EXPECT_EQ(blocks_of_region({.member = "pier 2"}, assembly, true, "key").size(), 1u);
  pier.copies = Copies{.count = 3, .by = Vec3(0.0, 7.0, 1.0)};
  const Assembly steps = check_and_report(members_case({pier, top}), &row);
  EXPECT_LT((steps.sheets[4].origin - Vec3(6.0, 14.0, 2.0)).norm(), 1e-14);
}

/// A barrel over walls, as long as it is wide.
Member nave() {
  VaultSurface barrel;
  barrel.plan.kind = Plan::Kind::line;
  barrel.plan.length = 4.0;
  barrel.profile.kind = Profile::Kind::chain;
  barrel.profile.points = {{3.0, 3.0, 0.0}, {0.0, 4.0, 7.0}, {0.0, 3.0}, {}};
  barrel.thickness = 1.0;
  Member member;
  member.name = "nave";
  member.surface = barrel;
  member.bond = RunningBond{16, 4, 2};
  return member;
}

/// A quarter of a circle that rises to a vertical bed between 3 and 3.5 m.
Member buttress() {
  VaultSurface half;
  half.plan.kind = Plan::Kind::line;
  half.plan.length = 1.0;
  half.profile.kind = Profile::Kind::chain;
  half.profile.points = {{2.5, 2.5, 0.5}, {0.0, 1.0, 3.0}, {0.0, 2.0}, {}};
  half.thickness = 0.5;
  Member member;
  member.name = "buttress";
  member.surface = half;
  member.bond = StackBond{8, 1, 2};
  member.beside = Beside{"nave", Beside::Side::right};
  member.at = Place{{0.0, 1.3, 0.0}, 0.0};
  return member;
}

// Two flying buttresses lean on the walls of a nave: both meet its face at x = 4 and x = -4, and both push.
TEST(Members, LeanOnOthersAndHaveMirrorImages) {
  Member leaning = buttress();
  leaning.mirror = Mirror{};
  ModelReport report;
  const Assembly assembly = check_and_report(members_case({nave(), leaning}), &report);
  EXPECT_EQ(report.islands, 1);
  ASSERT_EQ(assembly.sheets.size(), 3u);
  EXPECT_EQ(assembly.sheets[2].name, "buttress 2");
  EXPECT_LT((assembly.sheets[1].origin - Vec3(3.5, 1.3, 0.0)).norm(), 1e-14) << "0.5 m before the wall";
  std::array<double, 3> volume{}, moment{};  // of the members, about x = 0
  for (const Block& block : assembly.blocks) {
    if (block.fixed) continue;
    const size_t member = block.ring < 16 ? 0 : block.ring < 24 ? 1 : 2;
    volume[member] += block.volume;
    moment[member] += block.volume * block.centroid.x();
  }
  EXPECT_NEAR(volume[2] / volume[1], 1.0, 1e-13);
  EXPECT_NEAR(moment[2] / moment[1], -1.0, 1e-13);
  int leaning_blocks = 0;
  for (const Part& part : assembly.parts)
    if (assembly.blocks[part.block].ring == 15 + 8 || assembly.blocks[part.block].ring == 15 + 16) {
      Eigen::AlignedBox3d box;
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        for (const int v : assembly.face(f)) box.extend(assembly.vertices[v]);
      EXPECT_NEAR(std::min(std::abs(box.min().x()), std::abs(box.max().x())), 4.0, 1e-14);
      ++leaning_blocks;
    }
  EXPECT_GT(leaning_blocks, 1);
}

// A spur beside a tower touches its support, and no stone of its round wall.
TEST(Members, DoNotLeanOnSupports) {
  Member spur;
  spur.name = "spur";
  spur.surface = WallSurface{.length = 1.2, .height = 4.0, .thickness = 0.6};
  spur.bond = RunningBond{8, 2, 2};
  spur.at = Place{{0.0, -0.3, 0.0}};
  spur.beside = Beside{"tower", Beside::Side::right};
  Member round = tower("tower", 6.0);
  round.bond = RunningBond{8, 32, 2};
  const std::string refusal = refusal_of(members_case({round, spur}));
  EXPECT_NE(refusal.find("nothing of spur touches tower in their common plane"), std::string::npos)
      << refusal;
}

// A mirror image of a member that is its own mirror image is the member.
TEST(Members, AMirroredDomeIsTheDome) {
  Member dome = tower("dome", 10.0);
  VaultSurface surface = std::get<VaultSurface>(dome.surface);
  surface.plan.kind = Plan::Kind::polygon;
  surface.plan.sides = 6;
  dome.surface = surface;
  dome.bond = HerringboneBond{.rings = 6, .blocks_per_ring = 12, .spirals = 2, .phase = 0.3};
  dome.mirror = Mirror{{8.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  const Assembly assembly = generate(members_case({dome}));
  const size_t half = assembly.blocks.size() / 2;
  ASSERT_EQ(assembly.blocks.size(), 2 * half);
  EXPECT_LT((assembly.sheets[1].origin - Vec3(16.0, 0.0, 0.0)).norm(), 1e-14);
  for (size_t b = 0; b < half; ++b) {
    const Block &one = assembly.blocks[b], &image = assembly.blocks[half + b];
    EXPECT_NEAR(image.volume / one.volume, 1.0, 1e-12);
    EXPECT_LT((Vec3(16.0 - one.centroid.x(), one.centroid.y(), one.centroid.z()) - image.centroid).norm(),
              1e-13);
    if (one.fixed) continue;
    // The sail and the position in it follow from the azimuth in the frame of the image.
    const Vec3 own = assembly.sheets[1].own(image.centroid);
    const double turn = 2.0 * std::numbers::pi, azimuth = std::atan2(own.y(), own.x());
    const double sails = (azimuth < 0.0 ? azimuth + turn : azimuth) / turn * 6.0;
    EXPECT_LE(std::abs(image.sail + 0.5 * (1.0 + image.sail_position) - sails), 0.25) << b;
  }
}

// Supports end at the common plane: each stone stands on one support, and no support reaches into a
// neighbour.
TEST(Members, BesideEachOtherShareNoSupport) {
  Member aisle = nave();
  aisle.name = "aisle";
  aisle.beside = Beside{"nave", Beside::Side::left};
  ModelReport one, both;
  check_and_report(members_case({nave()}), &one);
  const Assembly assembly = check_and_report(members_case({nave(), aisle}), &both);
  EXPECT_EQ(both.num_supports, 2 * one.num_supports);
  EXPECT_GT(both.num_joints, 2 * one.num_joints) << "the walls touch";
  for (const Part& part : assembly.parts) {
    if (!assembly.blocks[part.block].fixed) continue;
    double low = 1e9, high = -1e9;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f)) {
        low = std::min(low, assembly.vertices[v].x());
        high = std::max(high, assembly.vertices[v].x());
      }
    EXPECT_TRUE(high <= -4.0 + 1e-13 || low >= -4.0 - 1e-13) << low << " to " << high;
  }
}

// A joint takes nothing from the member in which it lies, on whichever side its normal points.
TEST(Members, StandBesideTheEndNotBesideAJoint) {
  Member one, other;
  one.name = "one";
  one.surface = WallSurface{.length = 4.0, .height = 2.0, .thickness = 0.5};
  one.bond = RunningBond{4, 8, 2};
  one.cuts.resize(1);
  one.cuts[0].as = Cut::As::joint;
  one.cuts[0].point = {2.25, 0.0, 0.0};
  other = one;
  other.name = "other";
  other.cuts.clear();
  other.beside = Beside{"one", Beside::Side::right};
  for (const double side : {1.0, -1.0}) {
    one.cuts[0].normal = {side, 0.0, 0.0};
    ModelReport report;
    const Assembly assembly = check_and_report(members_case({one, other}), &report);
    EXPECT_EQ(assembly.sheets[1].origin.x(), 4.0);
    EXPECT_NEAR(report.volume, 8.0, 1e-13) << "rounding of sums";
    EXPECT_EQ(report.islands, 1);
  }
}

// Two piers with a gap of 0.3 m, each on a support that would reach 1 m beyond it, under the other: they end
// in the middle of the gap, also where a drain through the foot leaves three parts of each support.
TEST(Members, StandOnTheirOwnSupportsOnly) {
  for (const bool is_drained : {false, true}) {
    SCOPED_TRACE(is_drained);
    std::vector<Member> piers;
    for (const char* name : {"one", "other"}) {
      Member pier;
      pier.name = name;
      pier.surface = WallSurface{1.0, 2.0, 0.5};
      pier.bond = StackBond{1, 1, 2};
      if (!piers.empty()) pier.at = Place{{1.3, 0.0, 0.0}, 0.0};
      if (is_drained) {
        Cut& drain = pier.cuts.emplace_back();
        drain.kind = Cut::Kind::prism;
        drain.axis = Cut::Axis::y;
        drain.u = {0.4, 0.6, 0.6, 0.4};
        drain.v = {-0.3, -0.3, 0.1, 0.1};
      }
      piers.push_back(pier);
    }
    ModelReport report;
    const Assembly assembly = check_and_report(members_case(piers), &report);
    EXPECT_EQ(report.num_joints, 2);
    for (const Part& part : assembly.parts)
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        for (const int v : assembly.face(f)) {
          const bool first = part.block < 2;
          EXPECT_LE((first ? 1.0 : -1.0) * (assembly.vertices[v].x() - 1.15), 1e-12)  // rounding
              << "block " << part.block;
        }
  }
}

// The fixed ring of each tower, and the block that holds one at a cut, have the member that they bear.
TEST(Members, HaveTheirOwnSupports) {
  Member east = tower("east", 6.0), west = tower("west", 6.0);
  west.at = Place{{-11.0, 0.0, 0.0}, 0.0};
  Cut held;
  held.point = Vec3(2.0, 0.0, 0.0);
  held.normal = Vec3::UnitX();
  held.as = Cut::As::held;
  west.cuts = {held};
  const Assembly assembly = generate(members_case({east, west}));
  std::vector<std::string> bears;
  for (const Block& block : assembly.blocks)
    if (block.fixed) bears.push_back(assembly.members.at(block.member));
  EXPECT_EQ(bears, (std::vector<std::string>{"east", "west", "west"}));
}

TEST(Members, OfOneEntryHaveNamesIfItIsRepeated) {
  Member copied = tower("v", 3.0), mirrored = copied;
  EXPECT_TRUE(generate(members_case({copied})).members.empty());
  copied.copies = Copies{.count = 2, .by = Vec3(0.0, 7.0, 0.0)};
  mirrored.mirror = Mirror{{6.0, 0.0, 0.0}, Vec3::UnitX()};
  for (const Member& member : {copied, mirrored})
    EXPECT_EQ(generate(members_case({member})).members, (std::vector<std::string>{"v", "v 2"}));
}

TEST(Members, AreRefusedWithTheirNames) {
  Member low = tower("low", 10.0), wide = tower("wide", 20.0), beside = tower("beside", 10.0);
  wide.on = "low";
  EXPECT_NE(refusal_of(members_case({low, wide})).find("the member wide floats"), std::string::npos);
  Member arch;  // from the air above the inside of the tower to a support of its own
  arch.name = "arch";
  arch.on = "low";
  arch.surface = ArchSurface{.span = 3.0};
  arch.bond = StackBond{11, 1, 1, {}};
  EXPECT_NE(refusal_of(members_case({low, arch})).find("geometry.members[1].on = low: nothing of arch"),
            std::string::npos);
  beside.at = Place{{8.0, 0.0, 0.0}, 0.0};
  EXPECT_NE(refusal_of(members_case({low, beside})).find("move one member by `at`"), std::string::npos);
  Member cap = tower("cap", 10.0);
  cap.on = "low";
  VaultSurface segment;
  segment.profile.kind = Profile::Kind::segmental;
  segment.profile.rise = 2.0;
  segment.thickness = 0.5;
  segment.eye = 1.0;
  cap.surface = segment;
  EXPECT_NE(refusal_of(members_case({low, cap})).find("the first bed of cap is not level"),
            std::string::npos);
}

}  // namespace
}  // namespace cupola::members_test
