#include "assembly/model/outward.hpp"

#include <gtest/gtest.h>

namespace cupola::outward_test {
namespace {

using Eigen::Vector3d;

// The crown joint of an arch had a thrust of +27.5 or -27.5 kN, as rounding put its centroid at x = +-1e-16.
TEST(Outward, OfTheCrownDoesNotDependOnRounding) {
  for (const double x : {-1e-15, 0.0, 1e-15}) {
    EXPECT_EQ(outward_at({x, 0.5, 3.4}, true), Vector3d(1, 0, 0));
    EXPECT_EQ(outward_at({x, -x, 3.4}, false), Vector3d(0, 0, 0));
  }
  EXPECT_EQ(outward_at({-1e-3, 0.5, 3.4}, true), Vector3d(-1, 0, 0));
  EXPECT_EQ(outward_at({0.0, -1e-3, 3.4}, false), Vector3d(0, -1, 0));
}

}  // namespace
}  // namespace cupola::outward_test
