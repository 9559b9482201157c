#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "assembly/files/csv_text.hpp"

namespace cupola {

/// One column of a table that is written row by row: its key in the header, and the text of its cell, which
/// is quoted where CSV requires it.
template <class Row>
struct CsvColumn {
  const char* key;
  std::string (*cell)(const Row&);
};

/// The header of a table, without the end of the line.
template <class Columns>
std::string csv_header(const Columns& columns) {
  std::vector<std::string> keys;
  for (const auto& column : columns) keys.emplace_back(column.key);
  return fmt::format("{}", fmt::join(keys, ","));
}

/// One row, likewise.
template <class Columns, class Row>
std::string csv_row(const Columns& columns, const Row& row) {
  std::vector<std::string> cells;
  for (const auto& column : columns) cells.push_back(csv_text(column.cell(row)));
  return fmt::format("{}", fmt::join(cells, ","));
}

}  // namespace cupola
