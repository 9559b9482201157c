// Joints of blocks that consist of several convex parts.
#include <gtest/gtest.h>

#include "solver/collision/contact_detector.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::divided_test {
namespace {

using namespace testing;  // the scenes

ContactSet contacts_at_rest(const Assembly& assembly) {
  return ContactDetector(assembly, DetectionOptions{}).update(initial_poses(assembly));
}

// A part of 0.5 mm, less than 1e-3 of the stone, bears at the edge of the bed.
TEST(ContactDetector, NarrowPiecesBelongToTheBedThatTheyContinue) {
  for (const double overhang : {0.0, 2e-4}) {
    SCOPED_TRACE(overhang);
    Assembly scene = make_boxes({{.center = {0, 0, -0.5}, .size = {2, 1, 1}, .fixed = true}});
    add_block({}, &scene);
    add_box_part({.center = {0.49975 + overhang, 0, 0.5}, .size = {0.9995, 1, 1}}, false, false, &scene);
    add_box_part({.center = {0.99975 + overhang, 0, 0.5}, .size = {0.0005, 1, 1}}, false, false, &scene);
    compute_mass_properties(&scene);
    const ContactSet set = contacts_at_rest(scene);
    ASSERT_EQ(set.patches.size(), 1u);
    EXPECT_NEAR(set.patches.front().area, 1.0 - overhang, 1e-9);  // the parts are merged within 1e-9 m
  }
}

// Two separate feet of one block on the slab remain two patches.
TEST(ContactDetector, SeparateFeetStaySeparatePatches) {
  Assembly scene = box_on_floor(Vec3(1, 1, 1));
  add_block({}, &scene);
  add_box_part({.center = {3.0, 0, 0.5}}, false, false, &scene);
  add_box_part({.center = {5.0, 0, 0.5}}, false, false, &scene);
  compute_mass_properties(&scene);
  EXPECT_EQ(contacts_at_rest(scene).patches.size(), 3u);
}

}  // namespace
}  // namespace cupola::divided_test
