#pragma once

#include <string>

namespace cupola {

/// One column of a table: its key in the header, and the text of its cell.
template <class Row>
struct CsvColumn {
  const char* key;
  std::string (*cell)(const Row&);
};

/// The header of a table, without the end of the line.
template <class Columns>
std::string csv_header(const Columns& columns) {
  std::string text;
  for (const auto& column : columns) text += (text.empty() ? "" : ",") + std::string(column.key);
  return text;
}

/// One row, likewise.
template <class Columns, class Row>
std::string csv_row(const Columns& columns, const Row& row) {
  std::string text;
  const char* separator = "";
  for (const auto& column : columns) text += separator + column.cell(row), separator = ",";
  return text;
}

}  // namespace cupola
