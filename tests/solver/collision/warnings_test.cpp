#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/collision/geometry_warnings.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::warnings_test {
namespace {

using namespace testing;  // the scenes

/// Checks that all contacts are finite and have unit normals and positive areas.
void expect_valid_contacts(const Assembly& scene, const DetectionOptions& options = {}) {
  const ContactSet set = ContactDetector(scene, options).update(initial_poses(scene));
  for (const Contact& contact : set.points) {
    EXPECT_TRUE(contact.point_a.allFinite() && contact.point_b.allFinite());
    EXPECT_TRUE(std::isfinite(contact.gap));
    EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-12);
    EXPECT_GT(contact.area, 0.0);
  }
}

std::string only_warning(const Assembly& scene, const DetectionOptions& options = {}) {
  const auto warnings = geometry_warnings(scene, options);
  return warnings.size() == 1 ? warnings[0] : std::to_string(warnings.size()) + " warnings";
}

TEST(GeometryWarnings, AreEmptyForValidScenes) {
  EXPECT_TRUE(geometry_warnings(running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4, 2), {}).empty());
  const Eigen::Isometry3d far(Eigen::Translation3d(1e6, -1e6, 0));
  EXPECT_TRUE(geometry_warnings(transformed(running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4), far), {}).empty());
}

TEST(GeometryWarnings, OfAnOverlapStateBlocksAndDepth) {
  const Assembly scene = make_boxes({{.fixed = true}, {.center = {0, 0, 0.995}}, {.center = {0, 0, 1.995}}});
  EXPECT_EQ(only_warning(scene), "blocks 0 and 1 overlap by 0.005 m: their contacts start compressed");
  expect_valid_contacts(scene);
}

// A tenth of the default margin, and a hair on each side. A joint that is closed somewhere is none.
TEST(GeometryWarnings, OfJointsThatAreDrawnOpen) {
  const auto with_gap = [](double gap) {
    return make_boxes(
        {{.fixed = true}, {.center = {0, 0, 1 + 0.75 * gap}}, {.center = {0, 0, 2 + 1.75 * gap}}});
  };
  EXPECT_TRUE(geometry_warnings(with_gap(0.999e-3), {}).empty());
  EXPECT_TRUE(
      only_warning(with_gap(2e-3))
          .starts_with(
              "2 joints are drawn open within contact.margin, by up to 0.002 m between blocks 1 and 2: "))
      << only_warning(with_gap(2e-3));
  DetectionOptions ignored;
  ignored.ignore_initial_gaps = true;
  EXPECT_TRUE(geometry_warnings(with_gap(2e-3), ignored).empty());
  Assembly stepped = make_boxes({{.size = {2, 1, 1}, .fixed = true}});
  add_block({}, &stepped);
  add_box_part({.center = {-0.5, 0, 1.002}}, false, true, &stepped);
  add_box_part({.center = {0.5, 0, 1}}, true, false, &stepped);
  compute_mass_properties(&stepped);
  EXPECT_TRUE(geometry_warnings(stepped, {}).empty());
}

TEST(GeometryWarnings, RejectOverlapsBeyondTheMargin) {
  const auto message = [](const Assembly& scene) {
    try {
      geometry_warnings(scene, {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Assembly coincident = make_boxes({{}, {}});
  const std::string what_to_do = ": correct the geometry or increase contact.margin";
  EXPECT_EQ(message(coincident),
            "error: blocks 0 and 1 overlap by 1 m, more than contact.margin = 0.01 m" + what_to_do);
  EXPECT_EQ(message(make_boxes({{.fixed = true}, {.center = {0, 0, 0.98}}})),
            "error: blocks 0 and 1 overlap by 0.02 m, more than contact.margin = 0.01 m" + what_to_do);
  expect_valid_contacts(coincident);
}

TEST(GeometryWarnings, AreEmptyForCrossingBarsSeparatedOnlyByAnEdgePair) {
  const double half_diagonal = std::sqrt(0.5);
  const Assembly scene =
      make_boxes({{.fixed = true, .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitX()))},
                  {.center = {0, 0, 2 * half_diagonal + 0.001},
                   .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitY()))}});
  EXPECT_TRUE(geometry_warnings(scene, {}).empty());
}

TEST(GeometryWarnings, ReportIgnoredSlivers) {
  const Assembly scene = make_boxes({{.fixed = true}, {.center = {1 - 5e-4, 0, 1}}});
  EXPECT_EQ(only_warning(scene),
            "blocks 0 and 1: their joint is only 0.0005 m wide, less than 1e-3 of the smallest block, and is "
            "ignored");
  EXPECT_TRUE(ContactDetector(scene, {}).update(initial_poses(scene)).points.empty());
}

// The second part of the block meets the floor along 0.0005 m only, the first along 1 m.
TEST(GeometryWarnings, LeaveOutSliversOfAWideJoint) {
  Assembly scene = make_boxes({{.size = {1.001, 1, 1}, .fixed = true}});
  add_block({}, &scene);
  add_box_part({.center = {0, 0, 1}}, false, true, &scene);
  add_box_part({.center = {1, 0, 1}}, true, false, &scene);
  compute_mass_properties(&scene);
  EXPECT_TRUE(geometry_warnings(scene, {}).empty());
}

TEST(GeometryWarnings, ReportPartsThinnerThanTheMargin) {
  const Assembly scene = make_boxes({{.fixed = true}, {.center = {0, 0, 0.5005}, .size = {1, 1, 0.001}}});
  DetectionOptions options;
  options.margin = 0.002;
  EXPECT_EQ(
      only_warning(scene, options),
      "block 1: a part is only 0.001 m thick, thinner than contact.margin = 0.002 m; reduce the margin");
  expect_valid_contacts(scene, options);
}

TEST(GeometryWarnings, VeryThinPartsGiveValidContacts) {
  for (const double thickness : {1e-6, 1e-9, 1e-12}) {
    Assembly scene = box_on_floor(Vec3(1, 1, 1));
    add_block({}, &scene);
    add_box_part({.center = {0, 0, 1.5}}, false, true, &scene);
    add_box_part({.center = {0.5 + thickness / 2, 0, 1.5}, .size = {thickness, 1, 1}}, true, false, &scene);
    compute_mass_properties(&scene);
    expect_valid_contacts(scene);
    DetectionOptions perturbed;
    perturbed.perturbed_gjk = PerturbedGjkOptions{};
    EXPECT_THROW(ContactDetector(scene, perturbed), InputError) << thickness;
  }
}

TEST(GeometryWarnings, RejectFacesWithoutArea) {
  Assembly scene = box_on_floor(Vec3(1, 1, 1));
  scene.vertices[9] = scene.vertices[8];
  scene.vertices[11] = scene.vertices[10];
  try {
    ContactDetector(scene, {});
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("block 1: face"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cupola::warnings_test
