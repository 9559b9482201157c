#include "assembly/case/schema_table.hpp"

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

}  // namespace

std::string to_text(const SchemaTable& table) {
  std::string out;
  for (const SchemaRow& row : table.rows) {
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
