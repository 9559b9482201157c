// Skipped where the kernel has no such pages, and with sanitizers, which have their own operator new.
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cupola {
namespace {

/// Flags of the mapping that contains the address; "" if there is none.
std::string mapping_flags(std::uintptr_t address) {
  constexpr std::string_view kFlags = "VmFlags:";
  std::ifstream mappings("/proc/self/smaps");
  bool inside = false;
  for (std::string line; std::getline(mappings, line);) {
    std::uintptr_t start = 0, end = 0;
    char dash = 0;
    if (std::istringstream range(line); range >> std::hex >> start >> dash >> end && dash == '-')
      inside = start <= address && address < end;
    if (inside && line.starts_with(kFlags)) return line.substr(kFlags.size()) + " ";
  }
  return "";
}

TEST(HugePages, HoldLargeArrays) {
#ifdef CUPOLA_SANITIZED
  GTEST_SKIP() << "sanitizers have their own operator new";
#endif
  if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"))
    GTEST_SKIP() << "the kernel has no huge pages";
  const std::vector<char> large(100U << 20U);  // above every threshold of the heap
  const std::string flags = mapping_flags(reinterpret_cast<std::uintptr_t>(&large[large.size() / 2]));
  EXPECT_NE(flags.find(" hg "), std::string::npos) << flags;  // what madvise() sets
}

}  // namespace
}  // namespace cupola
