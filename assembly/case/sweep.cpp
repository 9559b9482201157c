#include "assembly/case/sweep.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

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

/// The cells of a line; blanks around them do not count.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream rest(line);
  for (std::string cell; std::getline(rest, cell, ',');) {
    const size_t first = cell.find_first_not_of(" \t\r");
    const size_t last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

bool is_key_path(std::string key) {
  std::erase_if(key, [](char c) { return c == '[' || c == ']'; });
  return fits_a_file_name(key);
}

}  // namespace

Samples read_samples(const std::string& path) {
  Samples samples;
  std::istringstream lines(read_text(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::vector<std::string> cells = cells_of(line);
    if (cells.empty() || (cells.size() == 1 && cells[0].empty()) || line.front() == '#') continue;
    const FileLocation where{path, number, 1};
    const bool header = samples.keys.empty();
    for (const std::string& cell : cells)
      if (!(header ? is_key_path(cell) : fits_a_file_name(cell)))
        throw InputError(where, fmt::format("`{}`: a {} consists of letters, digits and . - + _", cell,
                                            header ? "key path" : "value"));
    if (header) {
      for (const std::string& key : cells)
        if (std::ranges::count(cells, key) > 1)
          throw InputError(where, fmt::format("`{}` has two columns", key));
      samples.keys = std::move(cells);
      continue;
    }
    if (cells.size() != samples.keys.size())
      throw InputError(
          where, fmt::format("{} for {}; give one per key of the header line", counted(cells.size(), "value"),
                             counted(samples.keys.size(), "key")));
    samples.rows.push_back(std::move(cells));
    samples.places.push_back(where);
  }
  if (samples.rows.empty())
    throw InputError({path, 0, 0},
                     "has no members; expected a line of key paths and a line of values for each member");
  return samples;
}

std::vector<SweepMember> members_of(const Samples& samples, const std::string& prefix) {
  std::vector<SweepMember> members;
  for (const std::vector<std::string>& row : samples.rows) {
    SweepMember& member = members.emplace_back();
    member.name = fmt::format("{}{:04}", prefix, members.size());
    for (size_t k = 0; k < row.size(); ++k)
      member.settings.push_back(fmt::format("{}={}", samples.keys[k], row[k]));
  }
  return members;
}

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
                          "letters, digits, . - + and _{}",
                          swept.key, value,
                          value.starts_with('[')
                              ? fmt::format("; sweep one component, such as {}[0], or give the values as the "
                                            "columns of a file",
                                            swept.key)
                              : ""));
        longer.push_back({fmt::format("{}_{}{}", member.name, label(swept, sweep), value), member.settings});
        longer.back().settings.push_back(fmt::format("{}={}", swept.key, value));
      }
    }
    members = std::move(longer);
  }
  return members;
}

}  // namespace cupola
