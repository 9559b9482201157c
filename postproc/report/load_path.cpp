#include "postproc/report/load_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "postproc/figures/plot_style.hpp"

namespace cupola {

std::vector<Table::Column> path_columns() {
  return {
      {"time_s", "s",
       "to which loads, friction and supports follow their functions of time; found if the path has a "
       "length"},
      {"displacement_m", "m", "of the control block along its direction, from relative_to if given"},
      {"force_N", "N",
       "along that direction: of a support on the blocks; if the control block is free, the load added to "
       "all blocks since the time 0"},
      {"dissipated_J", "J",
       "in joints and ties since the start: friction, tension, cohesion, crushing and yielding"},
      {"mean_damage", "", "lost share of tension and cohesion, mean over the area of all joints"},
      {"widest_gap_m", "m", "widest opening of a joint: gap, or crack where joints have strength"}};
}

Table path_table(const CsvFile& csv) {
  Table t{"path", "Equilibria along the path of loads and support motions", path_columns(), {}};
  if (std::ranges::find(csv.columns, "widest_gap_m") == csv.columns.end())
    t.columns.pop_back();  // version 0.2
  for (size_t row = 0; row < csv.rows.size(); ++row) {
    t.rows.emplace_back();
    for (const Table::Column& column : t.columns)
      t.rows.back().emplace_back(csv.number(row, csv.column(column.key)));
  }
  return t;
}

std::vector<double> path_times(const CsvFile& csv) {
  std::vector<double> times;
  for (size_t row = 0; row < csv.rows.size(); ++row) times.push_back(csv.number(row, csv.column("time_s")));
  return times;
}

Figure path_figure(const Table& path) {
  double largest_force = 0.0, largest_displacement = 0.0, largest_work = 0.0;
  std::vector<std::array<double, 3>> points;
  for (const auto& row : path.rows) {
    const double u = std::get<double>(row[1]), force = std::get<double>(row[2]),
                 work = std::get<double>(row[3]);
    points.push_back({u, force, work});
    largest_displacement = std::max(largest_displacement, std::abs(u));
    largest_force = std::max(largest_force, std::abs(force));
    largest_work = std::max(largest_work, work);
  }
  const ForceUnit unit = force_unit(largest_force);
  const bool metres = largest_displacement >= 1.0, kilojoules = largest_work >= 1e3;
  std::vector<std::vector<double>> rows;
  for (const auto& [u, force, work] : points)
    rows.push_back({(metres ? 1.0 : 1e3) * u, unit.per_newton * force, (kilojoules ? 1e-3 : 1.0) * work});
  Figure f;
  f.name = "path";
  f.title = "Force against displacement";
  f.caption =
      "Every point is an equilibrium. Force and displacement are along the direction of the control: the "
      "force of a support on the blocks or, of a free block, the load added to all blocks since the time 0. "
      "The work is that dissipated in joints and ties.";
  f.width = 900;
  f.height = 620;
  f.commands = plot_style() + data_block("path", rows) +
               panels(panel_grid(2, 1, {0.11, 0.97, 0.10, 0.97}, 0.0, 0.06),
                      {fmt::format("unset key\nset ylabel 'force ({})'\n"
                                   "plot $path using 1:2 w lp lc rgb '{}' pt 7 ps 0.4 lw 2\n",
                                   unit.name, kBlue),
                       fmt::format("set ylabel 'dissipated ({})'\nset xlabel 'displacement ({})'\n"
                                   "plot $path using 1:3 w l lc rgb '{}' lw 2\n",
                                   kilojoules ? "kJ" : "J", metres ? "m" : "mm", kOrange)});
  return f;
}

}  // namespace cupola
