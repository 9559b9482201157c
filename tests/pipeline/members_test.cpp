// Members side by side: what each stack carries, and its thrust lines.

#include <cmath>

#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "postproc/evaluation/thrust.hpp"
#include "postproc/tables/shell_map.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::members_test {
namespace {

Member arch(const std::string& name, const Eigen::Vector3d& origin, double rotate_deg) {
  ArchSurface surface;
  surface.span = 6.0;
  surface.thickness = 0.8;
  Member member;
  member.name = name;
  member.at = Place{origin, rotate_deg};
  member.surface = surface;
  member.bond = StackBond{11, 1, 1, {}};
  return member;
}

Case two_arches() {
  Case scene;
  scene.geometry.members = {arch("here", Vec3::Zero(), 0.0), arch("there", {20.0, 3.0, 2.0}, 90.0)};
  scene.geometry.has_shell = false;
  scene.joints.friction = 0.7;
  scene.joints.compliance = Compliance::default_per(Compliance::Per::area);
  scene.analysis.tolerance = 1e-10;
  return scene;
}

// Two equal arches carry the same forces wherever they stand.
TEST(MembersSideBySide, CarryTheirOwnLoads) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(two_arches(), folder);
  ASSERT_EQ(e.rings.size(), 22u);
  constexpr double kBalance =
      1e-7;  // 1000 times the tolerance of the balance of a block, of which 11 are summed
  for (int k = 0; k < 11; ++k) {
    const RingSum &here = e.rings[k], &there = e.rings[11 + k];
    EXPECT_NEAR(there.load_above.z() / here.load_above.z(), 1.0, 1e-12) << k;
    EXPECT_NEAR(there.joint_force.z(), here.joint_force.z(), kBalance * here.load_above.norm()) << k;
    EXPECT_NEAR(there.radial_thrust, here.radial_thrust, kBalance * e.rings[0].load_above.norm()) << k;
    EXPECT_NEAR(there.height - here.height, 2.0, 1e-12) << k;
  }
  EXPECT_GT(e.rings[0].radial_thrust, 0.0);
  ASSERT_EQ(e.reactions.size(), 4u);
  for (const Reaction& reaction : e.reactions)
    EXPECT_NEAR(reaction.outward / e.reactions[0].outward, 1.0, 1e-6);
}

TEST(MembersSideBySide, HaveThrustLinesOfTheirOwn) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(two_arches(), folder);
  ASSERT_EQ(e.meridians.size(), 2u);
  EXPECT_EQ(e.meridians[0].thrust.name, "here");
  EXPECT_EQ(e.meridians[1].thrust.name, "there");
  ASSERT_GE(e.meridians[0].thrust.points.size(), 11u);
  for (int k = 0; k < 11; ++k) {
    const ThrustPoint &here = e.meridians[0].thrust.points[k], &there = e.meridians[1].thrust.points[k];
    EXPECT_EQ(here.bed, k);
    EXPECT_EQ(there.bed, 11 + k);
    EXPECT_NEAR(there.r / here.r, 1.0, 1e-6);
    EXPECT_NEAR(there.position, here.position, 1e-6);
  }
}

/// A drum with a dome on it.
std::vector<Member> tower(const std::string& name, const Place& place) {
  VaultSurface wall, dome;
  wall.profile.kind = Profile::Kind::straight;
  wall.profile.span = 4.0;
  wall.profile.height = 2.0;
  wall.thickness = 0.8;
  dome.profile.span = 4.0;
  dome.thickness = 0.5;
  dome.eye = 0.5;
  Member low, high;
  low.name = name;
  low.at = place;
  low.surface = wall;
  low.bond = RunningBond{3, 8, 2};
  high.name = name + " dome";
  high.on = name;
  high.surface = dome;
  high.bond = RunningBond{5, 8, 2};
  return {low, high};
}

// The thrust lines, hoop forces and maps of a dome do not depend on where it stands and how it is turned.
TEST(MembersSideBySide, DomesHaveLinesAboutTheirOwnAxes) {
  Case scene = two_arches();
  scene.geometry.members = tower("here", {});
  for (Member& member : tower("there", Place{{12.0, -7.0, 3.0}, 33.0}))
    scene.geometry.members.push_back(member);
  scene.postproc.meridians = {{"m", 20.0}};
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(scene, folder);
  ASSERT_EQ(e.meridians.size(), 2u);
  const ThrustLine &here = e.meridians[0].thrust, &there = e.meridians[1].thrust;
  EXPECT_EQ(there.name, "there dome m");
  ASSERT_EQ(here.points.size(), 8u);
  ASSERT_EQ(there.points.size(), 8u);
  constexpr double kBalance =
      1e-6;  // of the forces, 1e4 times the solver's tolerance: positions divide by them
  const Sheet axis = e.assembly.axis_of(8);
  for (size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(there.points[k].r / here.points[k].r, 1.0, kBalance);
    EXPECT_NEAR(there.points[k].position, here.points[k].position, 1e-4);
    EXPECT_LT((axis.own(there.points[k].intrados) - here.points[k].intrados - Vec3(0, 0, 3)).norm(), 1e-12);
  }
  ASSERT_EQ(e.meridians[1].hoop.size(), e.meridians[0].hoop.size());
  for (size_t k = 0; k < e.meridians[0].hoop.size(); ++k) {
    EXPECT_EQ(e.meridians[1].hoop[k].ring, 8 + e.meridians[0].hoop[k].ring);
    EXPECT_NEAR(e.meridians[1].hoop[k].sum(), e.meridians[0].hoop[k].sum(), kBalance * here.points[0].r);
  }
  const std::vector<ShellMap> maps = shell_maps(e);
  ASSERT_EQ(maps.size(), 4u);  // one per member
  for (const int i : {0, 1}) {
    EXPECT_EQ(maps[i + 2].first_ring, maps[i].first_ring + 8);
    ASSERT_EQ(maps[i + 2].boxes.size(), maps[i].boxes.size());
    for (size_t b = 0; b < maps[i].boxes.size(); ++b)
      EXPECT_NEAR(std::remainder(maps[i + 2].boxes[b].from - maps[i].boxes[b].from, 360.0), 0.0, 1e-9);
  }
}

// Of walls that hold the edges of a vault, and of two barrels that meet in a mitre, each on supports alone:
// the thrust is the sum of `outward_force_N` in reactions.csv, of a barrel on each side.
TEST(Members, TheThrustIsThatOfTheReactions) {
  for (const char* name : {"/sail_vault.yaml", "/barrels_corner.yaml"}) {
    const ProgramFolder folder;
    const Evaluation e = solve_and_evaluate(read_case(bundled_folder() + name), folder);
    for (const Sheet* sheet : pushing_sheets(e))
      for (const Thrust& thrust : thrusts_of(e, *sheet)) {
        const auto [first, end] = e.assembly.stack_of(sheet->first_ring);
        double sum = 0.0;
        for (const Reaction& r : e.reactions) {
          const Vec3 from_axis = e.assembly.blocks[r.block].centroid - sheet->origin;
          if (r.ring >= first && r.ring < end && (!thrust.towards || thrust.towards->dot(from_axis) > 0.0))
            sum += r.outward;
        }
        EXPECT_GT(sum, 1e4) << name;  // N
        EXPECT_NEAR(thrust.force, sum, 1e-12 * e.summary.weight_N) << name << ": rounding of the sums";
      }
  }
}

}  // namespace
}  // namespace cupola::members_test
