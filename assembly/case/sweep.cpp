#include "assembly/case/sweep.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

std::string last_word(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

/// The part of a member's name that stands for the key.
std::string label(const SweptKey& swept, const std::vector<SweptKey>& sweep) {
  const std::string word = last_word(swept.key);
  const auto shares = [&](const SweptKey& other) { return last_word(other.key) == word; };
  return std::count_if(sweep.begin(), sweep.end(), shares) == 1 ? word : swept.key;
}

bool fits_a_file_name(const std::string& value) {
  return !value.empty() && std::all_of(value.begin(), value.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '-' || c == '+' || c == '_';
  });
}

}  // namespace

std::vector<SweepMember> members_of(const std::vector<SweptKey>& sweep, const std::string& case_name) {
  if (sweep.empty())
    throw InputError(
        fmt::format("{} has no section `sweep`; add one that lists keys and their values", case_name));
  std::vector<SweepMember> members = {{case_name, {}}};
  for (const SweptKey& swept : sweep) {
    std::vector<SweepMember> longer;
    for (const SweepMember& member : members) {
      for (const std::string& value : swept.values) {
        if (!fits_a_file_name(value))
          throw InputError(
              fmt::format("sweep of {}: the value `{}` becomes part of a file name and may contain only "
                          "letters, digits, . - + and _",
                          swept.key, value));
        longer.push_back({fmt::format("{}_{}{}", member.name, label(swept, sweep), value), member.settings});
        longer.back().settings.push_back(fmt::format("{}={}", swept.key, value));
      }
    }
    members = std::move(longer);
  }
  return members;
}

}  // namespace cupola
