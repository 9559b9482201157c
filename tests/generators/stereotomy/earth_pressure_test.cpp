// The horizontal pressure of fill on the faces beside it, against closed forms.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/model/applied_loads.hpp"
#include "assembly/model/fill_pressure.hpp"
#include "generators/generate.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::earth_pressure_test {
namespace {

Case case_of(const std::string& text) {
  const std::string file = test::fresh_folder("earth_pressure") + "/case.yaml";
  std::ofstream(file) << text;
  return read_case(file);
}

struct Ledge {
  double height = 1.0, gap = 0.0;  // m
  int blocks = 1, courses = 1;     // of the ledge, of the wall behind it
  double turned = 0.0;             // deg, all about the z axis
};

/// Of soil up to the top of a wall of 2 x 1.5 x 4 m that lies on a ledge before it: the horizontal force, N,
/// and the height of its centre, m.
std::pair<Vec3, double> pressure_behind(const Ledge& ledge) {
  const double angle = ledge.turned * std::numbers::pi / 180.0, y = -1.0 - ledge.gap;
  const Case scene = case_of(fmt::format(
      R"(
geometry:
  members:
    - name: ledge
      at: {{origin: [{:.15g}, {:.15g}, 0], rotate_deg: {}}}
      surface: {{type: wall, length: 2, height: {}, thickness: 1}}
      bond: {{type: stack, rings: 1, blocks_per_ring: {}}}
    - name: wall
      at: {{rotate_deg: {}}}
      surface: {{type: wall, length: 2, height: 4, thickness: 1.5}}
      bond: {{type: stack, rings: {}, blocks_per_ring: 1}}
loads: {{faces: [{{fill: {{level: 4, unit_weight: 18000, horizontal: 0.4}}}}]}}
)",
      -y * std::sin(angle), y * std::cos(angle), ledge.turned, ledge.height, ledge.blocks, ledge.turned,
      ledge.courses));
  std::pair<Vec3, double> sum{Vec3::Zero(), 0.0};
  for (const PointForce& force : applied_loads(scene.loads, generate(scene))) {
    const double level = force.force.head<2>().norm();
    sum.first += Vec3(force.force.x(), force.force.y(), 0.0);
    sum.second += level * force.point.z();
  }
  sum.second /= sum.first.norm();
  return sum;
}

// A triangle of stress above the foot of the fill, k gamma L (H - h)^2 / 2 at a third of its height, however
// many courses and stones divide wall and ledge, in all directions; rounding of 1e5 N.
TEST(EarthPressure, ActsAboveTheFootOfTheFill) {
  const std::vector<Ledge> ledges{{},
                                  {.courses = 2},
                                  {.courses = 8},
                                  {.height = 2.5},
                                  {.gap = 5e-3},
                                  {.blocks = 2, .courses = 4},
                                  {.blocks = 2, .courses = 4, .turned = 30},
                                  {.blocks = 2, .turned = 123}};
  for (const Ledge& ledge : ledges) {
    const double depth = 4.0 - ledge.height, angle = ledge.turned * std::numbers::pi / 180.0;
    const Vec3 towards(-std::sin(angle), std::cos(angle), 0.0);
    const auto [force, height] = pressure_behind(ledge);
    EXPECT_LE((force - 0.4 * 18e3 * depth * depth * towards).norm(), 1e-7)
        << ledge.height << " " << ledge.gap << " " << ledge.blocks << " " << ledge.courses << " "
        << ledge.turned;
    EXPECT_NEAR(height, ledge.height + depth / 3.0, 1e-12);
  }
}

// Where the ledge ends, so does the fill: before half of the wall nothing presses.
TEST(EarthPressure, ActsBesideTheFillOnly) {
  const Case scene = case_of(R"(
geometry:
  members:
    - name: ledge
      at: {origin: [0, -1, 0]}
      surface: {type: wall, length: 1, height: 1, thickness: 1}
      bond: {type: stack, rings: 1, blocks_per_ring: 1}
    - name: wall
      surface: {type: wall, length: 2, height: 4, thickness: 1.5}
      bond: {type: stack, rings: 1, blocks_per_ring: 1}
loads: {faces: [{fill: {level: 4, unit_weight: 18000, horizontal: 0.4}}]}
)");
  double moment = 0.0, sum = 0.0;
  for (const PointForce& force : applied_loads(scene.loads, generate(scene))) {
    sum += force.force.y();
    moment += force.force.y() * force.point.x();
  }
  EXPECT_NEAR(sum, 0.4 * 18e3 * 1.0 * 4.5, 1e-8) << "rounding";
  EXPECT_NEAR(moment, 0.5 * sum, 1e-8) << "in the middle of the ledge";
}

// The inner faces of two spandrel walls, one of which is an extrados and the other an intrados, or both are
// one, bear alike in full; their joints, ends and outer faces bear nothing.
TEST(EarthPressure, OfTwoSpandrelWallsBothBearAlike) {
  for (const bool mirrored : {false, true}) {
    Case scene = read_case(bundled_folder() + "/bridge_spandrels.yaml");
    FaceLoad soil;
    soil.fill = Fill{.level = 4.2, .from = {}, .unit_weight = 18e3, .horizontal = 0.5};
    scene.loads.faces = {soil};
    if (mirrored) {
      Member& wall = scene.geometry.members.front();
      wall.copies.reset();
      wall.mirror = Mirror{{0.0, 2.0, 0.0}, {0.0, 1.0, 0.0}};
    }
    const Assembly assembly = generate(scene);
    double exact = 0.0;
    constexpr std::array kSides{FaceKind::extrados, FaceKind::intrados};
    for (const LoadedFace& face : faces_of_kind(assembly, kSides, 0, kLastRing, "spandrel"))
      if (std::abs(face.centroid.y() - 0.4) < 1e-9)
        exact -= fill_force(*scene.loads.faces[0].fill, face, scene.loads.gravity).force.y();
    EXPECT_GT(exact, 1e5);
    std::map<std::string, Vec3> sums;
    for (const char* member : {"spandrel", "spandrel 2", "barrel"}) sums[member].setZero();
    for (const PointForce& force : applied_loads(scene.loads, assembly))
      sums.at(assembly.members[assembly.blocks[force.block].member]) +=
          Vec3(std::abs(force.force.x()), force.force.y(), std::abs(force.force.z()));
    EXPECT_LE((sums["spandrel"] - Vec3(0.0, -exact, 0.0)).norm(), 1e-9 * exact) << "rounding, " << mirrored;
    EXPECT_LE((sums["spandrel 2"] - Vec3(0.0, exact, 0.0)).norm(), 1e-9 * exact) << "rounding";
    EXPECT_LE(std::abs(sums["barrel"].y()), 1e-9 * exact) << "its ends are free";
  }
}

// Earth against a vertical back presses on nothing, which the generator says, with the cure.
TEST(EarthPressure, OnAVerticalBackHasAWarning) {
  const auto warns = [](const std::string& wall) {
    const Case scene = case_of(
        "geometry:\n  surface: {type: wall, length: 4, height: 3, thickness: 1}\n"
        "  bond: {type: stack, rings: 6, blocks_per_ring: 4}\n" +
        wall);
    return std::ranges::any_of(generate(scene).case_warnings, [](const std::string& warning) {
      return warning.starts_with("loads.faces[0].fill.horizontal = 0.4: has no effect");
    });
  };
  const std::string earth = "loads: {faces: [{fill: {level: 3.3, unit_weight: 18000, horizontal: 0.4}}]}\n";
  EXPECT_TRUE(warns(earth));
  EXPECT_FALSE(warns("  cuts: [{type: plane, point: [0, 1, 0], normal: [0, 6, 0.01]}]\n" + earth));
}

// A traction beside a fill acts on the faces of its kind, as alone, not on beds above the level of the fill.
TEST(EarthPressure, ATractionBesideAFillKeepsToItsFaces) {
  const auto load_of = [](const std::string& faces) {
    const Case scene = case_of(fmt::format(R"(
geometry:
  surface: {{type: arch, span: 6, radius_ratio: 0.5, thickness: 0.6, width: 1}}
  bond: {{type: stack, rings: 11, blocks_per_ring: 1}}
loads: {{faces: [{}]}}
)",
                                           faces));
    double sum = 0.0;
    for (const PointForce& force : applied_loads(scene.loads, generate(scene))) sum -= force.force.z();
    return sum;
  };
  const double both = load_of("{traction: [0, 0, -1000], fill: {level: 3, unit_weight: 10000}}");
  EXPECT_NEAR(both, load_of("{traction: [0, 0, -1000]}, {fill: {level: 3, unit_weight: 10000}}"), 1e-9 * both)
      << "rounding";
}

}  // namespace
}  // namespace cupola::earth_pressure_test
