#include "postproc/studies/sweep_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "assembly/files/number_text.hpp"
#include "assembly/model/status.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/studies/sweep.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr size_t kMostPanels = 4;
constexpr std::array kColours{kBlue, kOrange, kGreen, kPurple, kSky};

double number_of(const Table::Cell& cell) {
  const double* value = std::get_if<double>(&cell);
  return value ? *value : std::numeric_limits<double>::quiet_NaN();
}

/// True if no number of the column is negative; its axis then starts at zero.
bool is_positive(const Table& table, size_t column) {
  return std::none_of(table.rows.begin(), table.rows.end(),
                      [column](const auto& row) { return number_of(row[column]) < 0.0; });
}

/// The unit in which a column is shown and its factor: lengths below one metre in mm, forces in kN or MN.
std::pair<double, std::string> readable_unit(const Table& table, size_t column) {
  const std::string& unit = table.columns[column].unit;
  const bool small = std::none_of(table.rows.begin(), table.rows.end(), [column](const auto& row) {
    return std::abs(number_of(row[column])) >= 1.0;
  });
  double largest = 0.0;
  for (const auto& row : table.rows)
    if (const double v = std::abs(number_of(row[column])); std::isfinite(v)) largest = std::max(largest, v);
  if (unit == "N")
    return largest < 1e6 ? std::pair(1e-3, std::string("kN")) : std::pair(1e-6, std::string("MN"));
  return unit == "m" && small ? std::pair(1e3, std::string("mm")) : std::pair(1.0, unit);
}

std::string text_of(const Table::Cell& cell) {
  const std::string* text = std::get_if<std::string>(&cell);
  return text ? *text : "";
}

/// Rows of the table by the values of all keys but the first, as the name of the curve.
std::map<std::string, std::vector<size_t>> curves_of(const Table& table, size_t keys) {
  std::map<std::string, std::vector<size_t>> curves;
  for (size_t r = 0; r < table.rows.size(); ++r) {
    std::string name;
    for (size_t k = 2; k <= keys; ++k) {
      const std::string& key = table.columns[k].key;
      name += fmt::format("{}{} {}", name.empty() ? "" : ", ", key.substr(key.rfind('.') + 1),
                          text_of(table.rows[r][k]));
    }
    curves[name].push_back(r);
  }
  return curves;
}

/// Members that do not stand, on the lower edge of the panels.
Rows without_equilibrium(const Table& table, size_t status) {
  Rows rows;
  for (const auto& row : table.rows) {
    double x = 0.0;
    if (!stands(text_of(row[status])) && text_of(row[status]) != "missing" &&
        read_number(text_of(row[1]), &x).empty())
      rows.push_back({x, 0.03});
  }
  return rows;
}

/// The last row with a value. gnuplot crashes where all labels of a plot lack one.
std::optional<size_t> last_point(const Rows& rows) {
  for (size_t r = rows.size(); r-- > 0;)
    if (std::isfinite(rows[r][1])) return r;
  return std::nullopt;
}

}  // namespace

Table in_readable_units(Table table) {
  for (size_t k = 0; k < table.columns.size(); ++k) {
    const auto [factor, unit] = readable_unit(table, k);
    table.columns[k].unit = unit;
    table.columns[k].floor *= factor;
    for (auto& row : table.rows)
      if (double* value = std::get_if<double>(&row[k])) *value *= factor;
  }
  // What the status of a run means, the verdict says in words.
  const size_t status = table.column_named("status");
  for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(status));
  table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(status));
  return table;
}

Figure sweep_figure(const std::vector<SweptKey>& sweep, const Table& table) {
  Figure f;
  f.name = "sweep";
  f.title = "Results over " + sweep.front().key;
  f.caption =
      "Filled points: the case stands; open points: it falls, or the run gives no verdict on it. Crosses on "
      "the lower edge: the run found no equilibrium (see the table).";
  for (const std::string& value : sweep.front().values)
    if (double x = 0.0; !read_number(value, &x).empty()) return f;
  const std::vector<int> falls = falls_of(table);
  std::vector<size_t> columns = varying_columns(table);
  if (columns.size() > kMostPanels) columns.resize(kMostPanels);
  if (columns.empty()) return f;
  const auto curves = curves_of(table, sweep.size());
  const Rows fallen = without_equilibrium(table, table.column_named("status"));
  std::string data = data_block("fallen", fallen);
  std::vector<std::string> plots;
  for (const size_t k : columns) {
    const Table::Column& column = table.columns[k];
    const auto [factor, unit] = readable_unit(table, k);
    const std::string label = column.meaning.substr(0, column.meaning.find(':'));
    plots.push_back(fmt::format("set ylabel '{}{}'\nset yrange [{}:*]\n", gnuplot_text(label),
                                unit.empty() ? "" : " (" + gnuplot_text(unit) + ")",
                                is_positive(table, k) ? "0" : "*"));
    std::string plot;
    size_t n = 0;
    for (const auto& [name, members] : curves) {
      Rows rows;
      for (const size_t r : members) {
        double x = 0.0;
        read_number(text_of(table.rows[r][1]), &x);
        rows.push_back({x, factor * number_of(table.rows[r][k]), falls[r] == 0 ? 7.0 : 6.0});
      }
      std::sort(rows.begin(), rows.end());
      const std::string block = fmt::format("column{}_{}", k, n);
      const char* colour = kColours[n % kColours.size()];
      data += data_block(block, rows);
      plot += fmt::format(
          "{} ${} using 1:2 w l lc rgb '{}' lw 1.5, ${} using 1:2:3 w p pt variable ps 0.9 lc rgb '{}'",
          plot.empty() ? "plot" : ",", block, colour, block, colour);
      if (const auto named = last_point(rows); named && !name.empty())
        plot += curve_label(block, *named, "$1", "$2", name, colour);
      ++n;
    }
    plots.back() += plot +
                    (fallen.empty() ? "" : ", $fallen using 1:2 axes x1y2 w p pt 2 ps 1.2 lc rgb '#444444'") +
                    "\n";
  }
  f.width = 900;
  f.height = 60 + 260 * static_cast<int>(columns.size());
  f.commands =
      plot_style() + data +
      fmt::format(
          "unset key\nset y2range [0:1]\nset offsets graph 0.03, graph 0.03, graph 0.08, graph 0.08\n"
          "set xlabel '{}'\n",
          gnuplot_text(sweep.front().key)) +
      panels(panel_grid(columns.size(), 1,
                        {0.1, curves.size() > 1 ? 0.8 : 0.97, 60.0 / f.height, 1.0 - 15.0 / f.height}, 0.0,
                        60.0 / f.height),
             plots);
  return f;
}

}  // namespace cupola
