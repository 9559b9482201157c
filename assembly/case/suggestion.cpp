#include "assembly/case/suggestion.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"

namespace cupola {
namespace {

/// Words that people use for keys.
constexpr std::array<std::pair<const char*, const char*>, 12> kOtherNames{
    {{"mu", "friction"},
     {"friction_coefficient", "friction"},
     {"friction_angle", "friction"},
     {"rho", "density"},
     {"weight", "unit_weight"},
     {"gamma", "unit_weight"},
     {"g", "gravity"},
     {"stiffness", "compliance"},
     {"diameter", "span"},
     {"courses", "rings"},
     {"bricks_per_ring", "blocks_per_ring"},
     {"tol", "tolerance"}}};

bool all_digits(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string last_part(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

/// `{friction: 0,2}` is read as the keys `friction: 0` and `2`.
std::string after_a_comma(const CaseNode& map, const std::string& key) {
  const CaseNode::Entry* half = map.find_entry(key);
  if (!half || half->value.kind != CaseNode::Kind::empty || !all_digits(key)) return {};
  for (const CaseNode::Entry& before : map.entries) {
    const FileLocation& where = before.value.where;
    const bool adjoins = where.line == half->where.line &&
                         where.column + static_cast<int>(before.value.text.size()) + 1 == half->where.column;
    if (adjoins && before.value.kind == CaseNode::Kind::scalar && all_digits(before.value.text))
      return fmt::format("; a decimal comma? Write {}: {}.{}.", before.key, before.value.text, key);
  }
  return {};
}

}  // namespace

std::string suggestion_for(const CaseNode& map, const std::string& key, const std::string& path) {
  if (std::string comma = after_a_comma(map, key); !comma.empty()) return comma;
  const auto other = std::ranges::find_if(kOtherNames, [&](const auto& pair) { return key == pair.first; });
  const std::string meant = other == kOtherNames.end() ? key : other->second;
  constexpr size_t kMost = 3;
  const auto& rows = case_schema_table().rows;
  if (std::ranges::find(rows, path, &SchemaRow::path) != rows.end()) return {};  // a key of another type
  std::vector<std::string> paths;
  for (const SchemaRow& row : rows)
    if (last_part(row.path) == meant && std::ranges::find(paths, row.path) == paths.end())
      paths.push_back(row.path);
  std::ranges::stable_sort(paths, {}, [](const std::string& p) { return std::ranges::count(p, '.'); });
  if (paths.size() > kMost) paths.resize(kMost);
  return paths.empty() ? "" : fmt::format("; did you mean {}?", fmt::join(paths, " or "));
}

std::string number_hint(const std::string& text) {
  const size_t comma = text.find(',');
  if (comma != std::string::npos && all_digits(text.substr(comma + 1)))
    return fmt::format("; a decimal comma? Write {}.{}", text.substr(0, comma), text.substr(comma + 1));
  return {};
}

}  // namespace cupola
