#include "solver/contact/methods/anderson.hpp"

#include <gtest/gtest.h>

namespace cupola::anderson_test {
namespace {

VecX affine(double slope, double offset, const VecX& x) {
  return slope * x + VecX::Constant(x.size(), offset);
}

// Of an affine map of one number, two points give the fixed point. After a restart no difference may remain:
// one between two maps would lead far from the fixed points of both.
TEST(Anderson, ForgetsTheLastMapAtARestart) {
  Anderson anderson(5);
  VecX x = VecX::Constant(1, 3.0);
  for (const double slope : {0.5, -3.0, 0.99}) {
    anderson.restart();
    const VecX first = anderson.next(x, affine(slope, 1.0, x));
    EXPECT_EQ(first, affine(slope, 1.0, x)) << slope;
    x = anderson.next(first, affine(slope, 1.0, first));
    EXPECT_NEAR(x[0], 1.0 / (1.0 - slope), 1e-12 / (1.0 - slope)) << slope;  // rounding over 1 - slope
  }
}

}  // namespace
}  // namespace cupola::anderson_test
