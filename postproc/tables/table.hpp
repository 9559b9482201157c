#pragma once

#include <limits>
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
    double floor = 0.0;   ///< of the numbers: up to it they are negligible
    double spread =
        std::numeric_limits<double>::infinity();  ///< m, of heights: those above it have its digits
  };
  using Cell = std::variant<double, int, std::string>;

  std::string name;   ///< name of the file without its ending
  std::string title;  ///< a sentence
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  size_t rows_elsewhere = 0;  ///< number of further rows, which only the CSV file holds

  size_t num_rows() const { return rows.size() + rows_elsewhere; }
  size_t column_named(const std::string& key) const;  ///< the table must have it
};

/// Header line of keys, then the rows. Numbers have all digits; undefined ones (NaN) are empty cells. Texts
/// are quoted where needed.
std::string to_csv(const Table& table);
/// Appends the rows, without the header.
void append_csv_rows(const Table& table, std::string* text);

/// A tabular environment of LaTeX: headings with units, cells as to_display.
std::string to_latex(const Table& table);

/// A cell as the report shows it: four significant digits, without exponent from 1e-3 to 1e7; 0 up to the
/// floor of its column; heights as place_text; nothing if undefined (NaN); texts unchanged.
std::string to_display(const Table::Cell& cell, const Table::Column& column = {});

}  // namespace cupola
