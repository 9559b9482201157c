#include "assembly/case/schema_table.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace cupola {
namespace {

constexpr size_t kNumColumns = 6;
using Cells = std::array<std::string, kNumColumns>;

Cells cells_of(const SchemaRow& row) {
  const std::string key = row.condition.empty() ? row.path : fmt::format("{} ({})", row.path, row.condition);
  return {key, row.type, row.unit, row.range, row.default_value, row.meaning};
}

}  // namespace

std::string to_markdown(const SchemaTable& table) {
  std::vector<Cells> lines{{"key", "type", "unit", "range", "default", "meaning"}};
  for (const SchemaRow& row : table.rows) lines.push_back(cells_of(row));
  std::array<size_t, kNumColumns> widths{};
  for (const Cells& cells : lines)
    for (size_t c = 0; c < kNumColumns; ++c) widths[c] = std::max(widths[c], cells[c].size());

  std::string out;
  for (size_t i = 0; i < lines.size(); ++i) {
    for (size_t c = 0; c < kNumColumns; ++c)
      out += c + 1 < kNumColumns ? fmt::format("| {:{}} ", lines[i][c], widths[c])
                                 : fmt::format("| {} |\n", lines[i][c]);
    if (i > 0) continue;
    for (size_t c = 0; c < kNumColumns; ++c)
      out += c + 1 < kNumColumns ? fmt::format("|{:-<{}}", "", widths[c] + 2) : std::string("|---------|\n");
  }
  return out;
}

}  // namespace cupola
