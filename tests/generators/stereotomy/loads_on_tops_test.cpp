// Fill and spread forces above a barrel that stands on walls wider than itself.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/model/applied_loads.hpp"
#include "assembly/model/fill_pressure.hpp"
#include "assembly/model/loaded_faces.hpp"
#include "generators/generate.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::loads_on_tops_test {
namespace {

constexpr double kLength = 3.0, kOuter = 3.2;  // m: of the barrel, and from its axis to the back of the walls

/// A barrel of 4 m on two walls, whose inner faces are `span` apart, and perhaps another member.
Case barrel_on_walls(double span, const std::string& loads, const std::string& other = "") {
  const std::string file = test::fresh_folder("loads_on_tops") + "/case.yaml";
  std::ofstream(file) << fmt::format(R"(
geometry:
  members:
    - name: wall
      at: {{origin: [0, 0, -2.5]}}
      mirror: {{point: [0, 0, 0], normal: [1, 0, 0]}}
      surface: {{type: vault, plan: {{type: line, length: {2}}}, profile: {{type: straight, span: {0}, height: 2.5}}, thickness: {1}}}
      bond: {{type: running, rings: 4, blocks_per_ring: 2, slices_per_block: 2}}
    - name: barrel
      on: wall
      surface:
        type: vault
        plan: {{type: line, length: {2}}}
        profile: {{type: segmental, span: 4, rise: 1}}
        thickness: 0.25
        beds: given
        bed_angles_deg: [0, 90]
      bond: {{type: running, rings: 9, blocks_per_ring: 3, slices_per_block: 2}}
{4}
material: {{unit_weight: 18000}}
loads: {3}
)",
                                     span, kOuter - 0.5 * span, kLength, loads, other);
  return read_case(file);
}

struct Sums {
  double walls = 0.0, barrel = 0.0;  // N, downwards
};

Sums sums_of(const Case& scene, const Assembly& assembly) {
  Sums sums;
  for (const PointForce& force : applied_loads(scene.loads, assembly)) {
    const bool of_barrel = assembly.members[assembly.blocks[force.block].member] == "barrel";
    (of_barrel ? sums.barrel : sums.walls) -= force.force.z();
  }
  return sums;
}

/// m, x up to which the barrel covers the tops of the walls, at z = 0.
double outer_edge_of_springing(const Assembly& assembly) {
  double edge = 0.0;
  for (const Part& part : assembly.parts)
    if (assembly.members[assembly.blocks[part.block].member] == "barrel")
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        for (const Vec3& p : face_points(assembly, f))
          if (std::abs(p.z()) < 1e-9) edge = std::max(edge, p.x());
  return edge;
}

// The tops of the walls lie 1.25 m below the level of the fill. Inside the vault nothing lies on them.
TEST(LoadsOnTops, FillLiesOnTheWallsBesideABarrel) {
  for (const double span : {4.0, 3.6})
    for (const char* member : {"", "member: barrel, "}) {
      const Case scene = barrel_on_walls(
          span, fmt::format("{{faces: [{{{}fill: {{level: 1.25, unit_weight: 16000}}}}]}}", member));
      const Assembly assembly = generate(scene);
      const double edge = outer_edge_of_springing(assembly);
      ASSERT_GT(edge, 2.25);
      const Sums sums = sums_of(scene, assembly);
      const double on_walls = 16000 * 1.25 * 2.0 * (kOuter - edge) * kLength;
      EXPECT_NEAR(sums.walls, on_walls, 1e-9 * on_walls) << span << member;
      EXPECT_GT(sums.barrel, 0.0);
    }
}

// A fill lies on the walls once if each member has its own.
TEST(LoadsOnTops, FillOfTheWallsAloneLiesOnNone) {
  const Case scene =
      barrel_on_walls(4.0, "{faces: [{member: wall, fill: {level: 1.25, unit_weight: 16000}}]}");
  EXPECT_THROW(generate(scene), InputError);
}

// N, of soil up to z = 3 m on a wall of 4 m by 2 m by 0.5 m, less a cut.
double fill_on_wall(const std::string& cut,
                    const std::string& load = "fill: {level: 3, unit_weight: 10000}") {
  const std::string file = test::fresh_folder("loads_on_tops") + "/wall.yaml";
  std::ofstream(file) << fmt::format(R"(
geometry:
  surface: {{type: wall, length: 4, height: 2, thickness: 0.5}}
  bond: {{type: running, rings: 6, blocks_per_ring: 8, slices_per_block: 2}}
  cuts: [{}]
loads: {{faces: [{{{}}}]}}
)",
                                     cut, load);
  const Case scene = read_case(file);
  double sum = 0.0;
  for (const PointForce& force : applied_loads(scene.loads, generate(scene))) sum -= force.force.z();
  return sum;
}

// Closed forms, to rounding: the depth of soil over each metre of the wall, also on parts of faces that the
// cut made between pieces of one stone, which stay covered. None lies on the sill of a window.
TEST(LoadsOnTops, FillLiesOnWhatACutLaidOpen) {
  EXPECT_NEAR(fill_on_wall("{type: plane, point: [0, 0, 1.5], normal: [0, 0, 1]}"), 4 * 0.5 * 1.5e4, 1e-7);
  // The slope reaches the top of 2 m at x = 1/3 m, and 0.9 m at the end.
  EXPECT_NEAR(fill_on_wall("{type: plane, point: [2, 0, 1.5], normal: [0.3, 0, 1]}"),
              0.5e4 * (1.0 / 3.0 + 11.0 / 3.0 * (3.0 - 1.45)), 1e-7);
  EXPECT_NEAR(fill_on_wall("{type: prism, axis: y, u: [1, 2, 2, 1], v: [1.2, 1.2, 3, 3]}"),
              0.5e4 * (3 * 1.0 + 1.8), 1e-7);
  EXPECT_NEAR(fill_on_wall("{type: prism, axis: y, u: [1, 2, 2, 1], v: [0.5, 0.5, 1.2, 1.2]}"), 4 * 0.5e4,
              1e-7);
}

// As above, for cuts that end on a bed, 4/3 m high: of the whole wall, and of a part, whose edge parts stones.
TEST(LoadsOnTops, FillLiesOnBedsThatACutLaidOpen) {
  EXPECT_NEAR(fill_on_wall("{type: plane, point: [0, 0, 1.3333333333333333], normal: [0, 0, 1]}"),
              4 * 0.5e4 * (3.0 - 4.0 / 3.0), 1e-7);
  EXPECT_NEAR(fill_on_wall("{type: prism, axis: y, u: [0.9, 2.1, 2.1, 0.9], "
                           "v: [1.3333333333333333, 1.3333333333333333, 3, 3]}"),
              0.5e4 * (2.8 + 1.2 * (3.0 - 4.0 / 3.0)), 1e-7);
}

// Beds at which the stones of a wall part or overlap stay covered, but for the last, on which soil
// lies through the head joints.
TEST(LoadsOnTops, FillLiesOnNoBedInsideAWall) {
  const std::string file = test::fresh_folder("loads_on_tops") + "/imperfect.yaml";
  std::ofstream(file) << R"(
geometry:
  surface: {type: wall, length: 4, height: 2, thickness: 0.5}
  bond: {type: running, rings: 6, blocks_per_ring: 8, slices_per_block: 2}
imperfections: {gap: 2e-3, seed: 3}
contact: {margin: 5e-3}
loads: {faces: [{fill: {level: 3, unit_weight: 10000}}]}
)";
  const Case scene = read_case(file);
  Assembly assembly = generate(scene);
  const auto on_beds = [&] {
    double sum = 0.0;
    for (const PointForce& force : applied_loads(scene.loads, assembly))
      if (force.point.z() < 1.6) sum -= force.force.z();
    return sum;
  };
  EXPECT_EQ(on_beds(), 0.0);
  for (Vec3& p : assembly.vertices) p.z() *= 1.0 + 1e-3;
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f)) assembly.vertices[v].z() -= 1e-4 * part.ring;
  EXPECT_EQ(on_beds(), 0.0);
}

// What lies above the level of a fill keeps none of it off: a barrel over the whole, as of an upper storey.
TEST(LoadsOnTops, AnUpperStoreyKeepsNoFillOff) {
  const char* fill = "{faces: [{fill: {level: 1.25, unit_weight: 16000}}]}";
  const char* upper = R"(
    - name: upper
      at: {origin: [0, 0, 1.3]}
      surface:
        {type: vault, plan: {type: line, length: 3}, profile: {type: semicircle, span: 12}, thickness: 0.25}
      bond: {type: running, rings: 9, blocks_per_ring: 3, slices_per_block: 2}
)";
  const Case alone = barrel_on_walls(4.0, fill), below = barrel_on_walls(4.0, fill, upper);
  const Sums a = sums_of(alone, generate(alone)), b = sums_of(below, generate(below));
  EXPECT_GT(a.walls, 0.0);
  EXPECT_NEAR(b.walls, a.walls, 1e-9 * a.walls) << "rounding";
  EXPECT_NEAR(b.barrel, a.barrel, 1e-9 * a.barrel) << "rounding";
}

// No soil lies inside the walls of 0.4 m and their supports, which stand on the whole length of a barrel.
TEST(LoadsOnTops, FillLiesBetweenSpandrelWalls) {
  Case scene = read_case(bundled_folder() + "/bridge_spandrels.yaml");
  FaceLoad soil;
  soil.fill.emplace();
  soil.fill->level = 3.6;
  soil.fill->unit_weight = 18e3;
  soil.member = "barrel";
  scene.loads.faces = {soil};
  const Assembly assembly = generate(scene);
  double sum = 0.0, expected = 0.0;
  for (const PointForce& force : applied_loads(scene.loads, assembly)) sum -= force.force.z();
  for (LoadedFace face : faces_of_kind(assembly, std::array{FaceKind::extrados}, 0, kLastRing, "barrel")) {
    face.polygon = below_plane(below_plane(face.polygon, -Vec3::UnitY(), -0.4), Vec3::UnitY(), 3.6);
    expected -= fill_force(*soil.fill, face, scene.loads.gravity).force.z();
  }
  EXPECT_NEAR(sum, expected, 1e-9 * expected) << "rounding";
}

// A traction on faces of kind top acts on what is free of the tops of a member.
TEST(LoadsOnTops, TractionActsOnTheFreeTopsOfAWall) {
  const Case scene = barrel_on_walls(4.0, "{faces: [{kind: top, member: wall 2, traction: [0, 0, -1000]}]}");
  const Assembly assembly = generate(scene);
  const double area = (kOuter - outer_edge_of_springing(assembly)) * kLength;
  EXPECT_NEAR(sums_of(scene, assembly).walls, 1000.0 * area, 1e-9 * area);
}

// A floor of 1.25 m over the crown: its load reaches barrel and walls in full; what is wider than the masonry
// keeps its intensity, and the rest is left out with a warning. 6.4 m of 8 m carry.
TEST(LoadsOnTops, AWideForceKeepsItsIntensity) {
  const auto floor = [](double width, double force) {
    return barrel_on_walls(4.0,
                           fmt::format("{{forces: [{{point: [0, 1.5, 1.25], force: [0, 0, -{}], spread: {{x: "
                                       "{}, y: 3, slope: 0}}}}]}}",
                                       force, width));
  };
  const Case whole = floor(6.4, 19.2e3), wide = floor(8.0, 24e3);
  const Assembly of_whole = generate(whole), of_wide = generate(wide);
  EXPECT_EQ(of_whole.case_warnings, std::vector<std::string>());
  ASSERT_EQ(of_wide.case_warnings.size(), 1u);
  EXPECT_EQ(of_wide.case_warnings[0].find("loads.forces[0].spread: 20 % of the force, 4.8e+03 N, "), 0u)
      << of_wide.case_warnings[0];
  const Sums a = sums_of(whole, of_whole), b = sums_of(wide, of_wide);
  const double edge = outer_edge_of_springing(of_whole);
  EXPECT_NEAR(a.barrel, 1000.0 * 2.0 * edge * kLength, 1e-8);
  EXPECT_NEAR(a.walls + a.barrel, 19.2e3, 1e-8);
  EXPECT_NEAR(b.walls, a.walls, 1e-8);
  EXPECT_NEAR(b.barrel, a.barrel, 1e-8);
}

// A rectangle that widens on its way down loads faces at many depths; the shares need no scaling to add up.
TEST(LoadsOnTops, AnAxleReachesTheExtradosInFull) {
  const Case scene = barrel_on_walls(
      4.0, "{forces: [{point: [-0.8, 1.5, 1.4], force: [0, 0, -1e5], spread: {x: 0.3, y: 1, slope: 0.5}}]}");
  const Assembly assembly = generate(scene);
  EXPECT_EQ(assembly.case_warnings, std::vector<std::string>());
  EXPECT_NEAR(sums_of(scene, assembly).barrel, 1e5, 1e-7);
}

// The first beds of an arch on abutments with skewbacks lie on the cut corners of these, 0.5 m by 4 m on
// either side; the fill presses on all of the tops behind them, from 4.4 m to 6 m, with (3 - 0.3) m of soil.
TEST(LoadsOnTops, AnArchStandsOnSkewbacks) {
  const Case scene = read_case(bundled_folder() + "/bridge_abutments.yaml");
  const Assembly assembly = generate(scene);
  double of_arch = 0.0, of_abutments = 0.0, on_tops = 0.0;
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const std::vector<Vec3> points = face_points(assembly, f);
      const Vec3 normal = polygon_plane(points).normal, middle = polygon_centroid(points);
      const double distance = 0.8 * middle.z() - 0.6 * (std::abs(middle.x()) - 4.0);
      if (std::abs(std::abs(normal.z()) - 0.8) > 1e-9 || std::abs(distance) > 1e-9) continue;
      (normal.z() < 0.0 ? of_arch : of_abutments) += polygon_area(points);
    }
  EXPECT_NEAR(of_arch, 2 * 0.5 * 4.0, 1e-9);
  EXPECT_NEAR(of_abutments, of_arch, 1e-9);
  for (const PointForce& force : applied_loads(scene.loads, assembly))
    if (std::abs(force.point.x()) > 4.4) on_tops -= force.force.z();
  EXPECT_NEAR(on_tops, 2 * 1.6 * 4.0 * 2.7 * 18e3, 1e-6);
}

/// A dome of 6 m and members beside it.
Case dome_beside(const std::string& others, const std::string& eye, const std::string& loads) {
  const std::string file = test::fresh_folder("loads_on_tops") + "/dome.yaml";
  std::ofstream(file) << fmt::format(R"(
geometry:
  members:{}
    - name: dome
      surface: {{type: vault, plan: {{type: circle}}, profile: {{type: semicircle, span: 6}}, thickness: 0.3, {}}}
      bond: {{type: running, rings: 8, blocks_per_ring: 8}}
loads: {}
)",
                                     others, eye, loads);
  return read_case(file);
}

constexpr const char* kWallBeside = R"(
    - name: wall
      at: {origin: [10, 0, 0]}
      surface: {type: wall, length: 4, height: 2, thickness: 1.5}
      bond: {type: running, rings: 2, blocks_per_ring: 2})";

// A lantern stands on the dome, a load on top on the wall beside it.
TEST(LoadsOnTops, ALanternStandsOnADomeAndATopLoadOnAWall) {
  const auto on_dome = [](const std::string& loads) {
    const Case scene = dome_beside(kWallBeside, "eye: 0.5", loads);
    const Assembly assembly = generate(scene);
    Sums sums;
    for (const PointForce& force : applied_loads(scene.loads, assembly))
      (force.point.x() > 5.0 ? sums.walls : sums.barrel) -= force.force.z();
    return sums;
  };
  const Sums lantern = on_dome("{lantern: {weight: 1000}}"), top_load = on_dome("{top_load: {weight: 1000}}");
  EXPECT_EQ(lantern.walls, 0.0);
  EXPECT_NEAR(lantern.barrel, 1000.0, 1e-9) << "rounding";
  EXPECT_NEAR(top_load.walls, 1000.0, 1e-9) << "rounding";
  EXPECT_EQ(top_load.barrel, 0.0);
}

// A closed dome beside a wall has no top for a lantern; which of two eyes it stands over, no key says.
TEST(LoadsOnTops, ALanternWithoutItsDomeIsRefused) {
  const auto refusal = [](const Case& scene) -> std::string {
    try {
      applied_loads(scene.loads, generate(scene));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string lantern = "{lantern: {weight: 1000}}";
  EXPECT_NE(refusal(dome_beside(kWallBeside, "eye: 0.5, key_stone: true", lantern))
                .find("no dome has faces of kind top"),
            std::string::npos)
      << refusal(dome_beside(kWallBeside, "eye: 0.5, key_stone: true", lantern));
  const std::string second = R"(
    - name: small
      at: {origin: [10, 0, 0]}
      surface: {type: vault, plan: {type: circle}, profile: {type: semicircle, span: 4}, thickness: 0.3, eye: EYE}
      bond: {type: running, rings: 8, blocks_per_ring: 8})";
  const auto with_eye = [&](const std::string& eye) {
    return std::string(second).replace(second.find("EYE"), 3, eye);
  };
  EXPECT_NE(refusal(dome_beside(with_eye("0.4"), "eye: 0.5", lantern)).find("top are on small and dome;"),
            std::string::npos)
      << refusal(dome_beside(with_eye("0.4"), "eye: 0.5", lantern));
}

}  // namespace
}  // namespace cupola::loads_on_tops_test
