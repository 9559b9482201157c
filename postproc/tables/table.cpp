#include "postproc/tables/table.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "assembly/files/csv_text.hpp"

namespace cupola {
namespace {

void append_csv(const Table::Cell& cell, fmt::memory_buffer* out) {
  if (const auto* number = std::get_if<double>(&cell)) {
    if (!std::isnan(*number)) fmt::format_to(std::back_inserter(*out), "{}", *number);
  } else if (const auto* count = std::get_if<int>(&cell)) {
    fmt::format_to(std::back_inserter(*out), "{}", *count);
  } else {
    out->append(csv_text(std::get<std::string>(cell)));
  }
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

std::string to_csv(const Table& table) {
  fmt::memory_buffer out;
  const auto end_of = [](size_t i, size_t n) { return i + 1 == n ? '\n' : ','; };
  for (size_t i = 0; i < table.columns.size(); ++i)
    fmt::format_to(std::back_inserter(out), "{}{}", csv_text(table.columns[i].key),
                   end_of(i, table.columns.size()));
  for (const auto& row : table.rows)
    for (size_t i = 0; i < row.size(); ++i) {
      append_csv(row[i], &out);
      out.push_back(end_of(i, row.size()));
    }
  return fmt::to_string(out);
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
      body += fmt::format("{}{}", i > 0 ? " & " : "", latex_text(to_display(row[i], table.columns[i].floor)));
    body += " \\\\\n";
  }
  return fmt::format("\\begin{{tabular}}{{{}}}\n\\hline\n{} \\\\\n\\hline\n{}\\hline\n\\end{{tabular}}\n",
                     kinds, head, body);
}

std::string to_display(const Table::Cell& cell, double floor) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<int>(&cell)) return fmt::format("{}", *count);
  const double value = std::get<double>(cell);
  const double size = std::abs(value);
  if (size <= floor) return "0";
  if (!std::isfinite(value)) return std::isnan(value) ? "" : value > 0 ? "∞" : "-∞";
  if (size >= 1000.0 && size < 1e7) return fmt::format("{:.0f}", value);
  if (size >= 1e-3 && size < 1e7) return fmt::format("{:.4g}", value);
  return fmt::format("{:.2e}", value);
}

}  // namespace cupola
