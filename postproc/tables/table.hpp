#pragma once

#include <string>
#include <variant>
#include <vector>

namespace cupola {

/// A table with a meaning and a unit for every column: written as CSV, shown in the report.
struct Table {
  struct Column {
    std::string key;      ///< snake_case, unit at the end, as in the CSV's header
    std::string unit;     ///< "" for pure numbers and names
    std::string meaning;  ///< one phrase
  };
  using Cell = std::variant<double, int, std::string>;

  std::string name;   ///< of the file, without ending
  std::string title;  ///< a sentence
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
};

/// Header line of keys, then the rows; numbers with all digits, texts quoted where needed.
std::string to_csv(const Table& table);

/// Number for a reader: four significant digits, no exponent from 1e-3 to 1e7; texts as they are.
std::string to_display(const Table::Cell& cell);

}  // namespace cupola
