// Results per wythe, from the case to the tables: a wall of two leaves, with and without headers, and a small
// dome of two shells with a solid base.

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "assembly/case/case_reader.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/tables/result_tables.hpp"
#include "postproc/tables/shell_map.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::wythes_test {
namespace {

constexpr double kLength = 1.2, kHeight = 0.48, kThickness = 0.12, kUnitWeight = 18000.0;  // m, N/m3
constexpr int kRings = 8;

/// Two leaves of bricks, loaded on the top of the back one: `push` away from the front leaf and `down`, Pa.
Case two_leaves(double push, double down) {
  Case scene;
  scene.geometry.surface = WallSurface{kLength, kHeight, 2.0 * kThickness};
  RunningBond bond;
  bond.rings = kRings;
  bond.blocks_per_ring = 5;
  bond.slices_per_block = 2;
  for (const char* name : {"back", "front"}) {
    Wythe wythe;
    wythe.name = name;
    wythe.thickness.values = {kThickness};
    wythe.bond = bond;
    scene.geometry.wythes.push_back(wythe);
  }
  scene.material.unit_weight = kUnitWeight;
  scene.joints.friction = 0.7;
  scene.joints.wythe.emplace().friction = 0.0;
  scene.joints.compliance = Compliance::default_per(Compliance::Per::area);
  FaceLoad load;
  load.faces = FaceKind::top;
  load.member = "back";
  load.traction = Vec3(0.0, push, -down);
  scene.loads.faces = {load};
  scene.analysis.tolerance = 1e-10;
  return scene;
}

// Blocks of the outer wythe pass every second bed of the inner one. What crosses a bed is the same whether it
// is summed by wythes or over all.
TEST(Wythes, ThrustOfARingCountsTheBlocksThatPassItsBed) {
  Case scene;
  DomeSurface dome;
  dome.span = 6.0;
  dome.radius_ratio = 0.5;
  dome.crown_angle_deg = 70.0;
  scene.geometry.surface = dome;
  for (const int rings : {6, 3}) {
    RunningBond bond;
    bond.rings = rings;
    bond.blocks_per_ring = 12;
    bond.slices_per_block = 2;
    Wythe wythe;
    wythe.name = rings == 6 ? "inner" : "outer";
    wythe.thickness.values = {0.3};
    wythe.bond = bond;
    scene.geometry.wythes.push_back(wythe);
  }
  scene.material.unit_weight = kUnitWeight;
  scene.joints.friction = 0.8;
  scene.joints.compliance = Compliance::default_per(Compliance::Per::area);
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(scene, folder);
  ASSERT_EQ(e.summary.status, Status::stable) << e.summary.message;
  ASSERT_EQ(e.rings.size(), 6u);
  for (const RingSum& ring : e.rings) {
    double outward = 0.0;
    for (const WytheSum& sum : e.wythes) outward += sum.ring == ring.ring ? sum.outward_force : 0.0;
    EXPECT_NEAR(ring.radial_thrust, outward, 1e-12 * e.summary.weight_N)
        << "rounding of the sums, ring " << ring.ring;
  }
}

// The back leaf leans away from the front one, so that neither helps the other. At the depth z below the top,
// a length of wall has N = down t + gamma t z and M = push t z: the normal forces act M / N from the middle,
// towards the back (position 0).
TEST(Wythes, EachLeafOfAWallCarriesItsOwnLoad) {
  const double push = 60.0, down = 1000.0;
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(two_leaves(push, down), folder);
  ASSERT_EQ(e.summary.status, Status::stable) << e.summary.message;
  ASSERT_EQ(e.wythes.size(), 2u * kRings);
  for (const WytheSum& sum : e.wythes) {
    const bool back = sum.wythes.from == 0;
    const double z = kHeight * (kRings - sum.ring) / kRings;
    const double weight = kUnitWeight * kThickness * kLength * z, load = down * kThickness * kLength;
    const double force = weight + (back ? load : 0.0);
    const double moment = back ? push * kThickness * kLength * z : 0.0;
    // The solver balances the blocks to 1e-10 of their mean weight.
    EXPECT_NEAR(sum.vertical_force, force, 1e-6 * force) << sum.ring;
    EXPECT_NEAR(sum.position, 0.5 - moment / force / kThickness, 1e-6) << sum.ring;
    EXPECT_NEAR(sum.pressure, force / (kThickness * kLength), 1e-6 * sum.pressure) << sum.ring;
  }
}

// Headers in every other course: the load of the back leaf reaches the front one.
TEST(Wythes, HeadersShareTheLoadOfALeaf) {
  Case scene = two_leaves(0.0, 50000.0);
  Bonders header;
  header.name = "header";
  header.from = "back";
  header.to = "front";
  header.per_ring = 10;
  header.every = 2;
  header.first = 1;
  scene.geometry.bonders = {header};
  scene.loads.faces[0].member = "header";
  scene.loads.faces[0].traction = Vec3(0.0, 0.0, -50000.0);
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(scene, folder);
  ASSERT_EQ(e.summary.status, Status::stable) << e.summary.message;
  for (const RingSum& ring : e.rings) {
    double vertical = 0.0, share = 0.0;
    for (const WytheSum& sum : e.wythes) {
      if (sum.ring != ring.ring) continue;
      vertical += sum.vertical_force;
      EXPECT_TRUE(std::isnan(sum.outward_force)) << "a wall";
      share += sum.share;
      EXPECT_EQ(sum.wythes.count(), 1) << "headers stand on leaves and carry leaves";
      EXPECT_NEAR(sum.share, 0.5, 1e-3) << "the headers are loaded in their middle";
    }
    EXPECT_NEAR(vertical, ring.joint_force.z(), 1e-12 * vertical) << "rounding of the sums";
    EXPECT_TRUE(std::isnan(ring.radial_thrust)) << "a wall";
    EXPECT_NEAR(share, 1.0, 1e-12);
  }
  // One map per leaf; a header is in both.
  const std::vector<ShellMap> maps = shell_maps(e);
  ASSERT_EQ(maps.size(), 2u);
  EXPECT_EQ(shell_table(maps[1], {}).name, "wall_front");
  for (const ShellMap& map : maps)
    EXPECT_EQ(std::ranges::count(map.boxes, 1, &ShellBox::ring), 10) << "headers";
}

/// Two shells on a solid base of two courses, with ribs that cross the cavity, in 8 courses of 16 blocks.
Case two_shells() {
  Case scene;
  DomeSurface dome;
  dome.span = 20.0;
  dome.radius_ratio = 0.5;
  dome.crown_angle_deg = 60.0;
  scene.geometry.surface = dome;
  const auto shell = [](const char* name, double thickness, bool built) {
    Wythe wythe;
    wythe.name = name;
    wythe.thickness.values = {thickness};
    if (built) wythe.bond = RunningBond{.rings = 8, .blocks_per_ring = 16};
    return wythe;
  };
  scene.geometry.wythes = {shell("inner", 1.0, true), shell("cavity", 0.6, false),
                           shell("outer shell", 0.4, true)};
  const auto bonders = [](const char* name, const char* from, const char* to) {
    Bonders group;
    group.name = name;
    group.from = from;
    group.to = to;
    return group;
  };
  Bonders base = bonders("base", "inner", "outer shell"), rib = bonders("rib", "inner", "outer shell");
  base.per_ring = 16;
  base.where.to = 2.0;
  rib.per_ring = 8;
  rib.at = {0.0};
  rib.width = 0.25;
  rib.where.from = 2.0;
  rib.every = 2;
  Bonders between = rib;
  between.from = between.to = "cavity";
  between.first = 1;
  scene.geometry.bonders = {base, rib, between};
  scene.joints.compliance = Compliance::default_per(Compliance::Per::area);
  scene.analysis.tolerance = 1e-9;
  scene.postproc.meridians = {{"rib", 0.0}, {"between", 22.5}};
  scene.postproc.sections = {5.0};
  return scene;
}

TEST(Wythes, TheLinesAndSumsOfTwoShellsAddUpToTheWhole) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(two_shells(), folder);
  ASSERT_EQ(e.summary.status, Status::stable) << e.summary.message;
  ASSERT_EQ(e.meridians.size(), 2u);
  EXPECT_EQ(e.meridians[0].wythes.size(), 3u) << "the rib crosses the cavity";
  EXPECT_EQ(e.meridians[1].wythes.size(), 2u);
  for (const MeridianEvaluation& m : e.meridians) {
    ASSERT_FALSE(m.wythes.empty());
    for (const ThrustPoint& whole : m.thrust.points) {
      Vec3 force = Vec3::Zero();
      int found = 0;
      for (const ThrustLine& line : m.wythes)
        for (const ThrustPoint& p : line.points)
          if (p.bed == whole.bed) {
            force += p.force;
            ++found;
            if (p.is_placed()) {
              EXPECT_GE(p.position, -1e-9) << line.name << " pushes within its thickness";
              EXPECT_LE(p.position, 1.0 + 1e-9) << line.name;
            }
          }
      if (found > 0) {
        EXPECT_LT((force - whole.force).norm(), 1e-12 * whole.r) << "rounding of the sums";
      }
      if (whole.bed != 2) {  // where a rib stands on the base
        EXPECT_EQ(found > 0, whole.bed > 2) << "the base is one block through all wythes";
      }
    }
  }
  for (const RingSum& ring : e.rings) {
    double vertical = 0.0;
    for (const WytheSum& sum : e.wythes) vertical += sum.ring == ring.ring ? sum.vertical_force : 0.0;
    EXPECT_NEAR(vertical, ring.joint_force.z(), 1e-11 * vertical) << "rounding of the sums";
  }
  // Blocks between the shells have no skin; their axes follow the thickness of their beds.
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b)
    if (e.shell.wythes[b] == WytheRange{1, 2} && !e.assembly.blocks[b].fixed) {
      EXPECT_NEAR(e.axes[b].thickness, 0.6, 0.02) << "m, less the depth of the facets";
      EXPECT_GT(e.last.fields[b].meridional_force, 0.0);
    }
  const Figure figure = thrust_figure(e, e.meridians[0]);
  for (const char* data :
       {"$cut_0 <<", "$cut_3 <<", "$wythe_0 <<", "$wythe_1_graphs <<", "title 'outer shell'"})
    EXPECT_NE(figure.commands.find(data), std::string::npos) << data;
  std::vector<std::string> names;
  visit_tables(e, [&](const Table& table) { names.push_back(table.name); });
  for (const char* name :
       {"wythes", "members", "thrust_rib", "thrust_rib_inner", "thrust_rib_cavity", "thrust_rib_outer_shell",
        "shell_inner", "shell_cavity", "shell_outer_shell", "section_5m"})
    EXPECT_EQ(std::ranges::count(names, name), 1) << name;
}

}  // namespace
}  // namespace cupola::wythes_test
