#include "assembly/files/seen_cracks.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola {
namespace {

constexpr double kFullTurn = 360.0;  // deg

/// A cell without the blanks around it, and where it begins.
struct Cell {
  std::string text;
  FileLocation where;
};

std::vector<Cell> cells_of(const std::string& line, const std::string& path, int number) {
  std::vector<Cell> cells;
  for (size_t start = 0; start <= line.size();) {
    const size_t end = std::min(line.find(',', start), line.size());
    const size_t first = std::min(line.find_first_not_of(" \t\r", start), end);
    const size_t last = end == first ? first : line.find_last_not_of(" \t\r", end - 1) + 1;
    cells.push_back({line.substr(first, last - first), {path, number, static_cast<int>(first) + 1}});
    start = end + 1;
  }
  return cells;
}

size_t column_of(const std::string& name, const std::vector<Cell>& header) {
  const auto found = std::ranges::find(header, name, &Cell::text);
  if (found != header.end()) return static_cast<size_t>(found - header.begin());
  std::vector<std::string> names;
  for (const Cell& cell : header) names.push_back(cell.text);
  const std::string near = nearest_name(name, names);
  throw InputError(header.front().where,
                   fmt::format("has no column {}{}", name,
                               near.empty() ? "; the first line names the columns azimuth_deg and width_m"
                                            : fmt::format("; did you mean it by {}?", near)));
}

double number_of(const std::string& column, const Cell& cell) {
  double value = 0.0;
  const std::string broken = read_number(cell.text, &value);
  if (!broken.empty()) throw InputError(cell.where, fmt::format("{} = `{}`: {}", column, cell.text, broken));
  return value;
}

void check(const SeenCrack& place, const std::vector<SeenCrack>& before, const Cell& azimuth,
           const Cell& width) {
  if (!before.empty() && place.azimuth <= before.back().azimuth)
    throw InputError(azimuth.where,
                     fmt::format("azimuth_deg = {:g}: must be above that of the row before, {:g}",
                                 place.azimuth, before.back().azimuth));
  if (!before.empty() && place.azimuth >= before.front().azimuth + kFullTurn)
    throw InputError(azimuth.where,
                     fmt::format("azimuth_deg = {:g}: must be within one turn of the first, {:g}",
                                 place.azimuth, before.front().azimuth));
  if (place.width < 0.0)
    throw InputError(
        width.where,
        fmt::format("width_m = {:g}: must be >= 0, where 0 means that no crack was seen", place.width));
}

}  // namespace

std::vector<SeenCrack> read_seen_cracks(const std::string& path) {
  std::vector<SeenCrack> places;
  std::vector<Cell> header;
  size_t azimuth = 0, width = 0;
  std::istringstream lines(read_text(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::vector<Cell> cells = cells_of(line, path, number);
    if (cells.size() == 1 && cells[0].text.empty()) continue;
    if (header.empty()) {
      header = cells;
      azimuth = column_of("azimuth_deg", header), width = column_of("width_m", header);
      continue;
    }
    if (cells.size() != header.size())
      throw InputError({path, number, 1},
                       fmt::format("{}, but the first line names {}", counted(cells.size(), "cell"),
                                   counted(header.size(), "column")));
    const SeenCrack place{number_of("azimuth_deg", cells[azimuth]), number_of("width_m", cells[width])};
    check(place, places, cells[azimuth], cells[width]);
    places.push_back(place);
  }
  const bool cracked = std::ranges::any_of(places, [](const SeenCrack& place) { return place.width > 0.0; });
  if (places.size() < 2 || !cracked)
    throw InputError({path, 0, 0}, "must hold two places or more, and a crack at one of them");
  return places;
}

}  // namespace cupola
