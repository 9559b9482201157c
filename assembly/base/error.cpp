#include "assembly/base/error.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

namespace cupola {
namespace {

std::string located(const FileLocation& where, const std::string& message) {
  if (where.line == 0) return fmt::format("{}: error: {}", where.file, message);
  if (where.column == 0) return fmt::format("{}:{}: error: {}", where.file, where.line, message);
  return fmt::format("{}:{}:{}: error: {}", where.file, where.line, where.column, message);
}

}  // namespace

InputError::InputError(const std::string& message) : std::runtime_error("error: " + message) {}

InputError::InputError(const FileLocation& where, const std::string& message)
    : std::runtime_error(located(where, message)) {}

int edit_distance(const std::string& a, const std::string& b) {
  const size_t width = b.size() + 1;
  std::vector<int> d((a.size() + 1) * width);
  for (size_t i = 0; i <= a.size(); ++i) d[i * width] = static_cast<int>(i);
  for (size_t j = 0; j <= b.size(); ++j) d[j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t j = 1; j <= b.size(); ++j) {
      const int replace = d[(i - 1) * width + j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      int best = std::min({d[(i - 1) * width + j] + 1, d[i * width + j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        best = std::min(best, d[(i - 2) * width + j - 2] + 1);
      d[i * width + j] = best;
    }
  }
  return d.back();
}

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: internal error: assertion failed: %s; please report it\n", file, line,
               condition);
  std::abort();
}

}  // namespace cupola
