#include "assembly/base/counted.hpp"

#include <gtest/gtest.h>

namespace cupola {
namespace {

TEST(Counted, AgreesWithTheNoun) {
  EXPECT_EQ(counted(0, "block"), "0 blocks");
  EXPECT_EQ(counted(1, "block"), "1 block");
  EXPECT_EQ(counted(2u, "block"), "2 blocks");
  EXPECT_EQ(counted(std::size_t{1}, "body", "bodies"), "1 body");
  EXPECT_EQ(counted(-1L, "body", "bodies"), "-1 bodies");
}

}  // namespace
}  // namespace cupola
