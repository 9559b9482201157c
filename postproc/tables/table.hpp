#pragma once

#include <string>
#include <variant>
#include <vector>

namespace cupola {

/// A table with the unit and meaning of every column. It is written as CSV and shown in the report.
struct Table {
  struct Column {
    std::string key;      ///< header of the CSV file: snake_case, unit last
    std::string unit;     ///< "" for pure numbers and names
    std::string meaning;  ///< one phrase
  };
  using Cell = std::variant<double, int, std::string>;

  std::string name;   ///< name of the file without its ending
  std::string title;  ///< a sentence
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
};

/// Header line of keys, then the rows. Numbers have all digits; texts are quoted where needed.
std::string to_csv(const Table& table);

/// A cell as the report shows it: four significant digits, without exponent from 1e-3 to 1e7; texts
/// unchanged.
std::string to_display(const Table::Cell& cell);

}  // namespace cupola
