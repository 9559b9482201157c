#include "assembly/files/number_text.hpp"

#include <gtest/gtest.h>

namespace cupola {
namespace {

TEST(ReadableForce, IsInKilonewtonsOrMeganewtons) {
  EXPECT_EQ(readable_force(163.42e6), "163.42 MN");
  EXPECT_EQ(readable_force(-1e6), "-1 MN");
  EXPECT_EQ(readable_force(999999.0), "1000 kN");
  EXPECT_EQ(readable_force(25.0), "0.025 kN");
  EXPECT_EQ(readable_force(0.0), "0 kN");
}

}  // namespace
}  // namespace cupola
