#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assembly/program/program.hpp"

namespace cupola {
namespace {

/// Flags of the mapping that contains an address, as in /proc/self/smaps.
std::string flags_of_mapping(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool inside = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = ' ';
    if (words >> std::hex >> begin >> dash >> end && dash == '-') inside = begin <= at && at < end;
    if (inside && line.starts_with("VmFlags:")) return line + " ";
  }
  return "";
}

class LargePages : public testing::Test {
 protected:
  void SetUp() override {
#ifdef CUPOLA_SANITIZED
    GTEST_SKIP() << "sanitizers have an allocator of their own";
#endif
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage/enabled"))
      GTEST_SKIP() << "the kernel has no large pages";
  }
};

// hg: the kernel was advised to use pages of 2 MB.
TEST_F(LargePages, BackTheHeap) {
  keep_freed_memory();
  constexpr std::size_t kSize = std::size_t{8} << 20U;
  void* const chunk = std::malloc(kSize);
  const std::string flags = flags_of_mapping(static_cast<char*>(chunk) + kSize / 2);
  std::free(chunk);
  EXPECT_NE(flags.find(" hg "), std::string::npos) << flags;
}

TEST_F(LargePages, BackArraysOutsideTheHeap) {
  const std::vector<char> array(100U << 20U);  // above every threshold of the heap
  const std::string flags = flags_of_mapping(&array[array.size() / 2]);
  EXPECT_NE(flags.find(" hg "), std::string::npos) << flags;
}

}  // namespace
}  // namespace cupola
