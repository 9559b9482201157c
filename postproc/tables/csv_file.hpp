#pragma once

#include <string>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {

/// A table lacks a column.
struct UnknownColumn : InputError {
  using InputError::InputError;
};

/// A CSV file with every cell as text.
struct CsvFile {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// Index of a column; UnknownColumn with the nearest name if there is none.
  size_t column(const std::string& name) const;
  /// NaN if the cell is empty; InputError if it is not a number.
  double number(size_t row, size_t column) const;
};

/// Reads a CSV file with a header line. Quoted cells may contain commas and doubled quotes. InputError if a
/// row is longer or shorter than the header.
CsvFile read_csv(const std::string& path);
CsvFile parse_csv(const std::string& text,
                  const std::string& path);  ///< the same from text; `path` is for messages

}  // namespace cupola
