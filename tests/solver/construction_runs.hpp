#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/course_scenes.hpp"

namespace cupola::testing {

using TableRow = std::map<std::string, std::string>;  ///< cells by column

inline std::vector<TableRow> parse_rows(const std::string& text) {
  std::vector<std::string> names;
  std::vector<TableRow> rows;
  std::istringstream lines(text);
  for (std::string line, cell; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> values;
    while (std::getline(cells, cell, ',')) values.push_back(cell);
    if (names.empty()) {
      names = values;
      continue;
    }
    rows.emplace_back();
    for (size_t i = 0; i < std::min(names.size(), values.size()); ++i) rows.back()[names[i]] = values[i];
  }
  return rows;
}

/// What a run of a staged analysis gives.
struct Built {
  Summary summary;
  std::vector<Frame> frames;
  std::vector<TableRow> stages, failures;
  double least_stands(size_t stage) const { return std::stod(stages.at(stage).at("least_stands")); }
  double least_moves(size_t stage) const { return std::stod(stages.at(stage).at("least_moves")); }
};

inline Built build(const Case& scene, const Assembly& assembly, AnalysisSinks sinks = {}) {
  Built built;
  std::map<std::string, std::string> tables;
  sinks.frame = [&](const Frame& frame) { built.frames.push_back(frame); };
  sinks.table = [&](const std::string& name, const std::string& text) { tables[name] = text; };
  built.summary = run_analysis(scene, assembly, sinks).value();
  built.stages = parse_rows(tables["construction.csv"]);
  built.failures = parse_rows(tables["failures.csv"]);
  return built;
}

/// Sum of the normal forces between two blocks, N.
inline double normal_force(const Frame& frame, int a, int b) {
  double sum = 0.0;
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.block_a[i] == a && frame.contacts.block_b[i] == b)
      sum += frame.contacts.normal_force[i];
  return sum;
}

}  // namespace cupola::testing
