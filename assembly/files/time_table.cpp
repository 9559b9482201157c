#include "assembly/files/time_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

/// Reads the two numbers of a line; false if the line is empty or a comment.
bool read_row(std::string line, const FileLocation& where, double* time, double* value) {
  line.erase(std::find(line.begin(), line.end(), '#'), line.end());
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  words >> std::ws;
  if (words.eof()) return false;
  std::string rest;
  if (!(words >> *time >> *value) || (words >> rest) || !std::isfinite(*time) || !std::isfinite(*value))
    throw InputError(where,
                     "expected two numbers, time (s) and value, with a comma or blanks between them; a line "
                     "that begins with # is a comment");
  return true;
}

}  // namespace

TableInTime read_time_table(const std::string& path) {
  TableInTime table;
  table.file = path;
  std::istringstream lines(read_text(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const FileLocation where{path, number, 1};
    double time = 0.0, value = 0.0;
    if (!read_row(line, where, &time, &value)) continue;
    if (!table.times.empty() && time <= table.times.back())
      throw InputError(where,
                       fmt::format("time {} follows {}: times must increase", time, table.times.back()));
    table.times.push_back(time);
    table.values.push_back(value);
  }
  if (table.times.empty())
    throw InputError({path, 0, 0}, "has no rows; expected two columns, time (s) and value");
  return table;
}

}  // namespace cupola
