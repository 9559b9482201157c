#include "postproc/figures/range_text.hpp"

#include <gtest/gtest.h>

namespace cupola {
namespace {

ForceRange thrust(const RangeEnd& min, const RangeEnd& max) {
  return {.quantity = "thrust", .unit = "N", .min = min, .max = max, .chosen = {}};
}

const RangeEnd kForty{RangeOutcome::bounded, 40e3, 40e3, {}};

TEST(RangeText, EndsThatReadAlikeAreOneValue) {
  EXPECT_EQ(range_ends(thrust({RangeOutcome::bounded, 12.1e3, 12.1e3, {}}, kForty)), "12.1 to 40 kN");
  EXPECT_EQ(range_ends(thrust({RangeOutcome::bounded, 39.9999e3, 39.9999e3, {}}, kForty)), "40 kN");
}

TEST(RangeText, SaysWhichEndWasNotFound) {
  EXPECT_EQ(range_ends(thrust({RangeOutcome::unconverged, 40e3, {}, {}}, kForty)), "40? to 40 kN");
  EXPECT_EQ(range_ends(thrust({RangeOutcome::unconverged, {}, {}, {}}, kForty)), "unknown to 40 kN");
  EXPECT_EQ(range_ends(thrust(kForty, {RangeOutcome::unbounded, {}, {}, {}})), "40 to ∞ kN");
}

}  // namespace
}  // namespace cupola
