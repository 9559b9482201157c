#include "assembly/case/schema_table.hpp"

#include <map>
#include <sstream>

#include <fmt/format.h>

namespace cupola {
namespace {

constexpr size_t kColumns = 120;

/// The words of `text` in lines of at most kColumns characters. Lines after the first begin with four blanks.
std::string wrapped(const std::string& text, size_t indent) {
  std::string out(indent, ' ');
  size_t column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > kColumns) {
      indent = 4;
      out += '\n';
      out.append(indent, ' ');
      column = indent;
    }
    if (column > indent) out += ' ', ++column;
    out += word;
    column += word.size();
  }
  return out + "\n";
}

bool is_below(const std::string& path, const std::string& section) {
  return path.starts_with(section) && path.size() > section.size() &&
         (path[section.size()] == '.' || path[section.size()] == '[');
}

/// The rows without the keys of each section that has the same ones as an earlier section. Its meaning names
/// that section.
std::vector<SchemaRow> without_repetitions(const std::vector<SchemaRow>& rows) {
  std::map<std::string, std::string> sections;  // by their keys, with all that is said about them
  std::vector<SchemaRow> out;
  for (size_t i = 0; i < rows.size(); ++i) {
    out.push_back(rows[i]);
    const std::string& section = rows[i].path;
    std::string keys;
    size_t end = i + 1;
    for (; end < rows.size() && (rows[end].path == section || is_below(rows[end].path, section)); ++end) {
      const SchemaRow& r = rows[end];
      for (const std::string& text :
           {r.path.substr(section.size()), r.condition, r.type, r.unit, r.range, r.default_value, r.meaning})
        keys += text + '\n';
    }
    if (keys.empty()) continue;
    const auto [first, is_new] = sections.try_emplace(keys, section);
    if (is_new) continue;
    out.back().meaning += "; keys as in " + first->second;
    i = end - 1;
  }
  return out;
}

}  // namespace

std::string to_text(const SchemaTable& table) {
  std::string out;
  for (const SchemaRow& row : without_repetitions(table.rows)) {
    std::string head =
        row.path + (row.condition.empty() ? "" : fmt::format(" ({})", row.condition)) + ": " + row.type;
    if (!row.unit.empty() && row.unit != "-") head += " in " + row.unit;
    if (!row.range.empty()) head += ", " + row.range;
    if (!row.default_value.empty())
      head += row.default_value == "required" ? ", required" : ", default " + row.default_value;
    out += wrapped(head, 0) + wrapped(row.meaning, 4);
  }
  return out;
}

}  // namespace cupola
