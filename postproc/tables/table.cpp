#include "postproc/tables/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/place_text.hpp"
#include "assembly/files/csv_text.hpp"

namespace cupola {
namespace {

void append_csv(const Table::Cell& cell, std::string* out) {
  std::array<char, 32> digits{};  // a double takes at most 24
  if (const auto* number = std::get_if<double>(&cell)) {
    if (!std::isnan(*number))
      out->append(digits.data(), fmt::format_to(digits.data(), FMT_COMPILE("{}"), *number));
  } else if (const auto* count = std::get_if<int>(&cell)) {
    out->append(digits.data(), fmt::format_to(digits.data(), FMT_COMPILE("{}"), *count));
  } else {
    out->append(csv_text(std::get<std::string>(cell)));
  }
}

char end_of(size_t i, size_t n) {
  return i + 1 == n ? '\n' : ',';
}

/// With what LaTeX would interpret escaped.
std::string latex_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\textbackslash{}";
    } else if (c == '~' || c == '^') {
      out += fmt::format("\\{}{{}}", c);
    } else {
      if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) out += '\\';
      out += c;
    }
  }
  return out;
}

}  // namespace

size_t Table::column_named(const std::string& key) const {
  const auto found = std::ranges::find(columns, key, &Column::key);
  CUPOLA_ASSERT(found != columns.end());
  return static_cast<size_t>(found - columns.begin());
}

std::string to_csv(const Table& table) {
  std::string text;
  for (size_t i = 0; i < table.columns.size(); ++i)
    text.append(csv_text(table.columns[i].key)).push_back(end_of(i, table.columns.size()));
  append_csv_rows(table, &text);
  return text;
}

void append_csv_rows(const Table& table, std::string* text) {
  for (const auto& row : table.rows)
    for (size_t i = 0; i < row.size(); ++i) {
      append_csv(row[i], text);
      text->push_back(end_of(i, row.size()));
    }
}

std::string to_latex(const Table& table) {
  std::string kinds, head, body;
  for (size_t i = 0; i < table.columns.size(); ++i) {
    const Table::Column& column = table.columns[i];
    const bool text = std::ranges::any_of(
        table.rows, [i](const auto& row) { return std::holds_alternative<std::string>(row[i]); });
    kinds += text ? 'l' : 'r';
    head += fmt::format("{}{}{}", i > 0 ? " & " : "",
                        latex_text(column.meaning.empty() ? column.key : column.meaning),
                        column.unit.empty() ? "" : " (" + latex_text(column.unit) + ")");
  }
  for (const auto& row : table.rows) {
    for (size_t i = 0; i < row.size(); ++i)
      body += fmt::format("{}{}", i > 0 ? " & " : "", latex_text(to_display(row[i], table.columns[i])));
    body += " \\\\\n";
  }
  return fmt::format("\\begin{{tabular}}{{{}}}\n\\hline\n{} \\\\\n\\hline\n{}\\hline\n\\end{{tabular}}\n",
                     kinds, head, body);
}

std::string to_display(const Table::Cell& cell, const Table::Column& column) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<int>(&cell)) return fmt::format("{}", *count);
  const double value = std::get<double>(cell);
  const double size = std::abs(value);
  if (size <= column.floor) return "0";
  if (!std::isfinite(value)) return std::isnan(value) ? "" : value > 0 ? "∞" : "-∞";
  if (size > column.spread) return place_text(value, column.spread, 4);
  if (size >= 1000.0 && size < 1e7) return fmt::format("{:.0f}", value);
  if (size >= 1e-3 && size < 1e7) return fmt::format("{:.4g}", value);
  return fmt::format("{:.2e}", value);
}

}  // namespace cupola
