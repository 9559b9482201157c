#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "postproc/figures/gnuplot.hpp"

namespace cupola::test {

/// Rows of a data block of a figure, without the blank ones.
inline std::vector<std::vector<double>> data_of(const Figure& figure, const std::string& name) {
  std::vector<std::vector<double>> rows;
  const std::string head = "$" + name + " << EOD\n";
  const size_t start = figure.commands.find(head);
  if (start == std::string::npos) return rows;
  std::istringstream lines(figure.commands.substr(start + head.size()));
  for (std::string line; std::getline(lines, line) && line != "EOD";) {
    std::istringstream numbers(line);
    std::vector<double> row;
    for (std::string number; numbers >> number;) row.push_back(std::stod(number));
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

}  // namespace cupola::test
