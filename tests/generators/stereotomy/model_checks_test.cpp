#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "tests/generators/models.hpp"

namespace cupola::model_checks_test {
namespace {

std::string complaint(const Assembly& assembly) {
  try {
    check_model(assembly, generated_tolerances(assembly));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Moves a block, which gets its own copies of its vertices.
void shift_block(Assembly* assembly, int block, const Vec3& shift) {
  std::vector<int> copy(assembly->vertices.size(), -1);
  for (const Part& part : assembly->parts) {
    if (part.block != block) continue;
    const int start = assembly->face_vertex_start[part.face_start];
    const int end = assembly->face_vertex_start[part.face_start + part.num_faces];
    for (int i = start; i < end; ++i) {
      int& v = assembly->face_vertices[i];
      if (copy[v] < 0) {
        copy[v] = static_cast<int>(assembly->vertices.size());
        assembly->vertices.push_back(assembly->vertices[v] + shift);
      }
      v = copy[v];
    }
  }
}

TEST(ModelChecks, DetectAnOverlapOfACentimetre) {
  Assembly wall = cut_assembly(wall_case(4, 2));
  ASSERT_EQ(complaint(wall), "");
  shift_block(&wall, 5, Vec3(0.0, 0.0, -0.01));
  EXPECT_NE(complaint(wall).find("overlap by 0.01 m"), std::string::npos) << complaint(wall);
}

TEST(ModelChecks, DetectAnOpenBlock) {
  Assembly wall = cut_assembly(wall_case(4, 2));
  wall.face_kinds[wall.parts[3].face_start] = FaceKind::internal;  // opens block 3
  EXPECT_NE(complaint(wall).find("block 3: not closed, 4 boundary edges"), std::string::npos)
      << complaint(wall);
}

TEST(ModelChecks, DetectABlockInsideOut) {
  Assembly wall = cut_assembly(wall_case(4, 2));
  const Part& part = wall.parts[2];
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    std::reverse(wall.face_vertices.begin() + wall.face_vertex_start[f],
                 wall.face_vertices.begin() + wall.face_vertex_start[f + 1]);
  EXPECT_NE(complaint(wall).find("block 2: inside out"), std::string::npos) << complaint(wall);
}

// The four slices of a block of a dome, 30 deg each, become 100 deg wide: the last covers the first. Turning
// the corners of slices about the axis keeps their faces plane.
TEST(ModelChecks, DetectABlockThatRunsIntoItself) {
  Assembly dome = cut_assembly(dome_case(3, 3, 4));
  const int block = 2;
  shift_block(&dome, block, Vec3::Zero());
  std::set<int> ids;
  for (const Part& part : dome.parts)
    if (part.block == block)
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        ids.insert(dome.face(f).begin(), dome.face(f).end());
  const Vec3& centroid = dome.blocks[block].centroid;
  const double middle = std::atan2(centroid.y(), centroid.x());
  for (const int id : ids) {
    Vec3& x = dome.vertices[id];
    const double angle = std::remainder(std::atan2(x.y(), x.x()) - middle, 2.0 * std::numbers::pi);
    const double turned = angle * 100.0 / 30.0, radius = std::hypot(x.x(), x.y());
    x = {radius * std::cos(turned), radius * std::sin(turned), x.z()};
  }
  EXPECT_NE(complaint(dome).find("block 2: two of its parts overlap by "), std::string::npos)
      << complaint(dome);
}

TEST(ModelChecks, DetectAWarpedFace) {
  Assembly wall = cut_assembly(wall_case(1, 1));
  const int f = wall.parts[1].face_start + 1;
  wall.vertices[wall.face(f)[0]].z() += 1e-6;
  EXPECT_NE(complaint(wall).find("off the plane of its face"), std::string::npos) << complaint(wall);
}

// Above the steep springings of a horseshoe the shell overhangs its own supports.
TEST(ModelChecks, NameTheWidthOfASupportInTheWay) {
  VaultSurface horseshoe;
  horseshoe.plan.kind = Plan::Kind::line;
  horseshoe.profile.kind = Profile::Kind::horseshoe;
  horseshoe.profile.span = 4.0;
  horseshoe.profile.below_deg = 80.0;
  horseshoe.thickness = 0.3;
  Case c;
  c.geometry.surface = horseshoe;
  c.geometry.bond = RunningBond{8, 2, 2};
  try {
    generate(c);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("block 0 is a support: reduce geometry.support_width"),
              std::string::npos)
        << error.what();
  }
  c.geometry.support_width = 0.1;
  EXPECT_NO_THROW(generate(c));
}

TEST(ModelChecks, CountIslandsAndBlocksWithoutJoint) {
  Assembly wall = cut_assembly(wall_case(4, 2));
  shift_block(&wall, 10, Vec3(0.0, 0.0, 2.0));  // a course is 1.5 m
  const ModelReport report = check_model(wall, generated_tolerances(wall));
  EXPECT_EQ(report.islands, 2);
  EXPECT_EQ(report.blocks_without_joint, std::vector<int>{10});
}

// A dome of 4 m was refused 2.8 km from the origin: "a vertex lies 9.09e-13 m off the plane of its face".
TEST(ModelChecks, AllowForTheRoundingOfCoordinatesFarFromTheOrigin) {
  for (const double away : {2e3, 1e5, 5.4e6}) {
    Case c = dome_case(8, 12);
    c.geometry.at = Place{{away, -away, 0.0}, 20.0};
    ModelReport report;
    check_and_report(c, &report);
    EXPECT_TRUE(report.narrow_joints.empty()) << away;
  }
}

// Rounding made joints of 2e-14 m, which are no narrow joints to warn of.
TEST(ModelChecks, DoNotWarnOfTheRoundingOfHeights) {
  for (const double height : {0.0, 300.0, 2600.0}) {
    Case c = read_case(CUPOLA_SOURCE_DIR "/cases/barrels_corner.yaml");
    for (Member& member : c.geometry.members) {
      if (!member.at) member.at.emplace();
      member.at->origin.z() += height;
    }
    ModelReport report;
    check_and_report(c, &report);
    EXPECT_TRUE(warnings_of(report).empty()) << height;
  }
}

}  // namespace
}  // namespace cupola::model_checks_test
