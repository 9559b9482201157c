#include "assembly/model/block_region.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/dynamics/heat.hpp"
#include "solver/dynamics/supports.hpp"
#include "tests/solver/motion_scenes.hpp"

// Regions of blocks, motions of supports by region, and the expansion of heated blocks.

namespace cupola {
namespace {

/// A sheet of one course.
Sheet sheet_at(const Vec3& origin, double turn, Sheet::ThrustLines lines) {
  return {.name = "shell", .num_rings = 1, .thrust_lines = lines, .origin = origin, .turn = turn};
}

/// Eight fixed cubes of 0.2 m on a circle of 2 m about an axis, at 0, 45, ..., 315 degrees from the x axis of
/// their sheet, each under a free one.
Assembly circle(const Vec3& origin = Vec3::Zero(), double turn = 0.0) {
  std::vector<testing::BoxSpec> boxes;
  for (int k = 0; k < 8; ++k)
    for (const bool fixed : {true, false}) {
      const double phi = k * M_PI / 4 + turn;
      boxes.push_back({.center = origin + Vec3(2 * std::cos(phi), 2 * std::sin(phi), fixed ? -0.1 : 0.1),
                       .size = Vec3::Constant(0.2),
                       .fixed = fixed});
    }
  Assembly assembly = testing::make_boxes(boxes);
  assembly.num_rings = 1;
  assembly.sheets = {sheet_at(origin, turn, Sheet::ThrustLines::by_azimuth)};
  return assembly;
}

std::string message_of_move(const SupportMove& move, const Assembly& assembly) {
  Case scene;
  scene.supports.moves = {move};
  try {
    make_support_motions(scene, assembly);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<Pose> moved(const SupportMove& move, const Assembly& assembly) {
  Case scene;
  scene.supports.moves = {move};
  std::vector<Pose> poses(assembly.blocks.size());
  for (size_t b = 0; b < poses.size(); ++b) poses[b].p_WB = assembly.blocks[b].centroid;
  place_supports(assembly, make_support_motions(scene, assembly), 1.0, &poses);
  return poses;
}

TEST(SupportRegion, MovesOutwardsByItsProfile) {
  const Assembly assembly = circle();
  SupportMove move;
  move.outward = 0.01;
  move.region.profile = AzimuthProfile{4, 0.0};
  const std::vector<Pose> poses = moved(move, assembly);
  for (int k = 0; k < 8; ++k) {
    const Vec3 centre = assembly.blocks[2 * k].centroid;
    const Vec3 outwards = Vec3(centre.x(), centre.y(), 0.0).normalized();
    const double factor = k % 2 == 0 ? 1.0 : -1.0;  // cos(4 phi)
    EXPECT_LT((poses[2 * k].p_WB - centre - factor * 0.01 * outwards).norm(), 1e-15) << k;
  }
}

TEST(SupportRegion, TiltTurnsTheTopOutwards) {
  const Assembly assembly = circle();
  SupportMove move;
  move.tilt_deg = 1.0;
  const std::vector<Pose> poses = moved(move, assembly);
  for (int k = 0; k < 8; ++k) {
    const Vec3 centre = assembly.blocks[2 * k].centroid;
    EXPECT_EQ(poses[2 * k].p_WB, centre);
    const Vec3 top = poses[2 * k].q_WB * Vec3(0, 0, 0.1);
    EXPECT_NEAR(top.dot(Vec3(centre.x(), centre.y(), 0.0).normalized()), 0.1 * std::sin(M_PI / 180), 1e-15);
  }
}

// Two sectors with a common end have no block in common.
TEST(SupportRegion, SectorsBeginAtABlockAndEndBeforeOne) {
  const Assembly assembly = circle();
  const auto blocks_in = [&](double from, double to) {
    std::vector<int> found;
    for (const RegionBlock& b : blocks_of_region({.sector = Sector{from, to}}, assembly, true, "key"))
      found.push_back(b.block / 2);
    return found;
  };
  EXPECT_EQ(blocks_in(0, 180), (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(blocks_in(180, 360), (std::vector{4, 5, 6, 7}));
  EXPECT_EQ(blocks_in(-45, 45), (std::vector{0, 7}));
  EXPECT_EQ(blocks_in(100, 170), (std::vector{3}));
  EXPECT_EQ(blocks_in(0, 360).size(), 8u);
  EXPECT_EQ(blocks_in(10, 370).size(), 8u);
}

// Sectors, profiles and outwards are those of the masonry wherever it stands, from its own x axis.
TEST(SupportRegion, CountsAboutTheAxisOfTheMasonry) {
  constexpr double kTurn = 0.5;  // rad
  const Assembly here = circle(), there = circle({30.0, 20.0, 0.0}, kTurn);
  SupportMove move;
  move.outward = 0.01;
  move.region.sector = Sector{-10.0, 170.0};
  move.region.profile = AzimuthProfile{1, 20.0};
  const std::vector<Pose> expected = moved(move, here), found = moved(move, there);
  const Eigen::AngleAxisd turn(kTurn, Vec3::UnitZ());
  for (size_t b = 0; b < found.size(); ++b) {
    const Vec3 shift = found[b].p_WB - there.blocks[b].centroid;
    // 100 times the rounding of coordinates of 30 m.
    EXPECT_LT((shift - turn * (expected[b].p_WB - here.blocks[b].centroid)).norm(), 1e-13) << b;
  }
}

// A ring round the axis and a block under the crown of an arch have no direction outwards, walls have none at
// all, and rounding must not choose one.
TEST(SupportRegion, RefusesToMoveOutwardsFromNothing) {
  using enum Sheet::ThrustLines;
  const Vec3 aside(3.3, 0.7, 0.0);
  Assembly block = testing::make_boxes({{.center = aside, .size = {4, 4, 1}, .fixed = true},
                                        {.center = aside + Vec3(1.0, 0.0, 1.0), .size = {1, 1, 1}}});
  block.num_rings = 1;
  SupportMove outward, tilt, sinking;
  outward.outward = tilt.tilt_deg = 0.001;
  sinking.displacement = Vec3(0.0, 0.0, -0.001);
  for (const auto lines : {by_azimuth, one, radial}) {
    block.sheets = {sheet_at(aside + Vec3(1e-15, 0.0, 0.0), 0.3, lines)};
    for (const SupportMove& move : {outward, tilt})
      EXPECT_NE(message_of_move(move, block).find("block 0 lies on the axis of the masonry"),
                std::string::npos);
    EXPECT_EQ(message_of_move(sinking, block), "");
  }
  block.sheets = {sheet_at(Vec3::Zero(), 0.0, none)};
  EXPECT_NE(message_of_move(outward, block).find("nothing says what is outwards of block 0"),
            std::string::npos);
  block.sheets = {sheet_at(aside - Vec3(5.0, 0.0, 0.0), 0.0, one)};
  EXPECT_EQ(message_of_move(outward, block), "");
  block.sheets = {sheet_at(aside - Vec3(0.0, 5.0, 0.0), 0.0, one)};  // along the crown
  EXPECT_NE(message_of_move(outward, block), "");
}

// The fixed blocks under the wythes of a member bear all of them.
TEST(SupportRegion, OfAMemberWithWythesIsNamedByEach) {
  Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .fixed = true},
                                           {.center = {0, 0, 0.5}},
                                           {.center = {0, 1, 0.5}},
                                           {.center = {9, 0, -0.5}, .fixed = true},
                                           {.center = {9, 0, 0.5}, .ring = 1},
                                           {.center = {9, 1, 0.5}, .ring = 1}});
  const std::array<int, 6> members{0, 0, 1, 2, 2, 3};
  for (size_t b = 0; b < members.size(); ++b) assembly.blocks[b].member = members[b];
  assembly.members = {"drum inner", "drum outer", "inner", "outer"};
  assembly.num_rings = 2;
  assembly.sheets = {{.name = "drum", .num_rings = 1}, {.name = "dome", .first_ring = 1, .num_rings = 1}};
  const auto support_of = [&](const std::string& member) {
    const std::vector<RegionBlock> found = blocks_of_region({.member = member}, assembly, true, "key");
    return found.size() == 1 ? found.front().block : -1;
  };
  for (const char* member : {"drum", "drum inner", "drum outer"}) EXPECT_EQ(support_of(member), 0) << member;
  for (const char* member : {"dome", "inner", "outer"}) EXPECT_EQ(support_of(member), 3) << member;
  EXPECT_THROW(blocks_of_region({.member = "drum"}, assembly, false, "key"), InputError) << "free blocks";
  // The same two stacks as a drum and its copy.
  assembly.members = {"drum inner", "drum outer", "drum inner 2", "drum outer 2"};
  assembly.member_originals = {"drum inner", "drum outer", "drum inner", "drum outer"};
  assembly.sheets[1].name = "drum 2";
  for (const char* member : {"drum", "drum inner", "drum outer"})
    EXPECT_EQ(blocks_of_region({.member = member}, assembly, true, "key").size(), 2u) << member;
  for (const char* member : {"drum 2", "drum inner 2"}) EXPECT_EQ(support_of(member), 3) << member;
  EXPECT_EQ(blocks_of_region({.member = "drum outer"}, assembly, false, "key").size(), 2u) << "free blocks";
}

TEST(SupportRegion, ErrorsNameWhatIsThere) {
  Assembly assembly = circle();
  assembly.members = {"pier", "vault"};
  const auto message = [&](const BlockRegion& region) {
    try {
      blocks_of_region(region, assembly, true, "supports.moves");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message({.member = "peer"}).find("did you mean 'pier'?"), std::string::npos);
  EXPECT_NE(message({.member = "vault"}).find("holds no fixed block"), std::string::npos);
  EXPECT_NE(message({.blocks = {BlockRef{1}}}).find("block 1 is not fixed"), std::string::npos);
  EXPECT_NE(message({.sector = Sector{100, 110}}).find("holds no fixed block"), std::string::npos);
  const Assembly floor = testing::box_on_floor({1, 1, 1});
  EXPECT_THROW(blocks_of_region({.profile = AzimuthProfile{2, 0}}, floor, true, "key"), InputError) << "axis";
}

TEST(HeatedBlocks, ALinearFieldStrainsWithoutRotatingTheCentroid) {
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 1.0});
  Case scene;
  BlockHeat heat;
  heat.change = 20.0;
  heat.gradient = Vec3(30.0, 0.0, 0.0);
  heat.expansion = 1e-5;
  scene.loads.heat = {heat};
  const HeatedBlocks heated(scene, assembly);
  std::vector<Pose> poses(2);
  for (const size_t b : {0, 1}) poses[b].p_WB = assembly.blocks[b].centroid;
  const auto displacement = [&](const Vec3& x) {
    Contact contact;
    contact.block_a = 0;
    contact.block_b = 1;
    contact.point_a = contact.point_b = assembly.blocks[1].centroid + x;
    return heated.separation(poses, contact, 1.0);
  };
  EXPECT_EQ(displacement(Vec3::Zero()), Vec3::Zero());
  const Vec3 x(0.3, -0.2, 0.1);
  const double step = 1e-4;
  Mat3 gradient;  // of the displacement
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = step * Vec3::Unit(k);
    gradient.col(k) = (displacement(x + d) - displacement(x - d)) / (2 * step);
  }
  const Mat3 strain = 0.5 * (gradient + gradient.transpose());
  const double expected = 1e-5 * (20.0 + 30.0 * 0.3);
  // Rounding of differences of displacements of 1e-4 m.
  EXPECT_LT((strain - expected * Mat3::Identity()).norm(), 1e-14);
  scene.loads.heat[0].through = 1.0;
  EXPECT_THROW(HeatedBlocks(scene, assembly), InputError) << "boxes have no extrados";
}

}  // namespace
}  // namespace cupola
