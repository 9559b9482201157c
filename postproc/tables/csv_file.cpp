#include "postproc/tables/csv_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/csv_text.hpp"

namespace cupola {
namespace {

/// The cells of the record that begins at `*start`, which moves to the next one. A quoted cell may hold line
/// ends.
std::vector<std::string> cells_at(const std::string& text, size_t* start) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (size_t& i = *start; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c == '\n' && !quoted) {
      ++i;
      break;
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = text_of_csv(cell);
  return cells;
}

}  // namespace

size_t CsvFile::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found != columns.end()) return static_cast<size_t>(found - columns.begin());
  const std::string near = nearest_name(name, columns);
  throw UnknownColumn(
      FileLocation{path},
      fmt::format("has no column {}{}", name, near.empty() ? "" : fmt::format(", did you mean {}?", near)));
}

double CsvFile::number(size_t row, size_t column) const {
  const std::string& cell = rows[row][column];
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);  // accepts inf, which tables contain
  if (*end != '\0')
    throw InputError(FileLocation{path, static_cast<int>(row) + 2, 0},
                     fmt::format("{} = `{}`: is not a number", columns[column], cell));
  return value;
}

CsvFile read_csv(const std::string& path) {
  return parse_csv(read_text(path), path);
}

CsvFile parse_csv(const std::string& text, const std::string& path) {
  CsvFile file;
  file.path = path;
  if (text.empty()) throw InputError(FileLocation{path}, "is empty: expected a header line");
  size_t start = 0;
  file.columns = cells_at(text, &start);
  while (start < text.size()) {
    file.rows.push_back(cells_at(text, &start));
    if (file.rows.back().size() != file.columns.size())
      throw InputError(
          FileLocation{path, static_cast<int>(file.rows.size()) + 1, 0},
          fmt::format("{} in a row, but {} in the header", counted(file.rows.back().size(), "cell"),
                      counted(file.columns.size(), "column")));
  }
  return file;
}

}  // namespace cupola
