#include "assembly/case/resolve_thresholds.hpp"

#include <gtest/gtest.h>

namespace cupola {
namespace {

Assembly blocks_of(double size) {
  Assembly assembly;
  for (const double scale : {1.0, 3.0, 1000.0}) {
    assembly.blocks.emplace_back();
    assembly.blocks.back().volume = scale * size * scale * size * scale * size;
  }
  assembly.blocks.back().fixed = true;
  return assembly;
}

TEST(ResolveThresholds, TakesHalfTheMeanSizeOfTheFreeBlocksOrHalfAMetre) {
  for (const double size : {0.05, 10.0}) {
    Analysis::Thresholds thresholds;
    resolve_thresholds(blocks_of(size), &thresholds);
    EXPECT_NEAR(thresholds.collapse(), size < 1.0 ? size : 0.5, 1e-12) << "sizes of 1 and 3";
  }
}

TEST(ResolveThresholds, KeepsWhatTheCaseGives) {
  Analysis::Thresholds thresholds;
  thresholds.displacement = 2.0;
  resolve_thresholds(blocks_of(0.05), &thresholds);
  EXPECT_EQ(thresholds.collapse(), 2.0);
}

}  // namespace
}  // namespace cupola
