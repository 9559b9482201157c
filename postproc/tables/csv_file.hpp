#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A table as the postprocessor wrote it: every cell as text.
struct CsvFile {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// Index of a column; InputError with the nearest name when there is none.
  size_t column(const std::string& name) const;
  double number(size_t row, size_t column) const;  ///< InputError when the cell is no number
};

/// Reads a CSV with a header line; cells in quotes may hold commas and doubled quotes. InputError when a
/// row is longer or shorter than the header.
CsvFile read_csv(const std::string& path);
CsvFile parse_csv(const std::string& text, const std::string& path);  ///< the same from bytes at hand

}  // namespace cupola
