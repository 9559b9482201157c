#include "assembly/program/warnings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/program/terminal.hpp"

namespace cupola {

std::vector<std::string> united(std::initializer_list<std::vector<std::string>> lists) {
  std::vector<std::string> all;
  for (const std::vector<std::string>& list : lists)
    for (const std::string& text : list)
      if (std::ranges::find(all, text) == all.end()) all.push_back(text);
  return all;
}

void report_warnings(std::string_view program, const std::vector<std::string>& warnings,
                     const std::vector<std::string>& printed_before, bool strict) {
  constexpr size_t kShown = 10;
  std::vector<std::string> fresh;
  for (const std::string& text : warnings)
    if (strict || std::ranges::find(printed_before, text) == printed_before.end()) fresh.push_back(text);
  const std::string word = in_colour("warning:", Colour::yellow, stderr);
  for (size_t i = 0; i < std::min(kShown, fresh.size()); ++i)
    fmt::print(stderr, "{}: {} {}\n", program, word, fresh[i]);
  if (fresh.size() > kShown)
    fmt::print(stderr, "{}: {} {} more; the report lists all\n", program, word, fresh.size() - kShown);
  if (strict && !warnings.empty())
    throw InputError(fmt::format("--strict: {}", warnings.size() == 1 ? "the warning above is an error"
                                                                      : "the warnings above are errors"));
}

}  // namespace cupola
