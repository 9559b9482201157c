#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace cupola::test {

/// The rows below the header of a CSV table of numbers.
inline std::vector<std::vector<double>> csv_numbers(const std::string& table) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(table);
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace cupola::test
