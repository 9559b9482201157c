#include "assembly/model/laying_course.hpp"

#include <gtest/gtest.h>

namespace cupola::laying_course_test {
namespace {

// Two abutments of two courses beside each other (rings 0, 1 and 2, 3) under an arch of five stones (4 to 8).
TEST(LayingCourse, AbutmentsBesideEachOtherAreHeldAlike) {
  Assembly bridge;
  bridge.num_rings = 9;
  bridge.sheets = {
      {.name = "abutment", .num_rings = 2},
      {.name = "abutment", .first_ring = 2, .num_rings = 2},
      {.name = "arch", .first_ring = 4, .num_rings = 5, .thrust_lines = Sheet::ThrustLines::one}};
  const auto held = [&](int course, int hold_below) {
    std::vector<int> rings;
    for (int ring = 0; ring < bridge.num_rings; ++ring) {
      Block block;
      block.ring = ring;
      if (laying_course(bridge, block) <= course && is_held(bridge, block, course, hold_below))
        rings.push_back(ring);
    }
    return rings;
  };
  constexpr int kCrown = 6;
  EXPECT_EQ(laying_course(bridge, 6), kCrown);
  EXPECT_EQ(held(kCrown, 1), (std::vector{0, 1, 2, 3, 4, 8}));
  EXPECT_EQ(held(kCrown, 2), (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(held(kCrown, 3), (std::vector{0, 2})) << "the upper courses of both abutments are solved";
  EXPECT_EQ(held(kCrown, 4), std::vector<int>());
  EXPECT_EQ(held(1, 0), std::vector{0}) << "within one abutment";
  EXPECT_EQ(held(kCrown, -1), std::vector<int>());
}

}  // namespace
}  // namespace cupola::laying_course_test
