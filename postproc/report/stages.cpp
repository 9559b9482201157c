#include "postproc/report/stages.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/figures/plot_style.hpp"

namespace cupola {

Table stage_table(const Evaluation& e, const CsvFile& csv) {
  const size_t ring = csv.column("ring"), blocks = csv.column("blocks"), verdict = csv.column("verdict");
  const size_t stands = csv.column("critical_stands"), moves = csv.column("critical_moves");
  Table t{"stages", "Construction, ring by ring", {}, {}};
  t.columns = {
      {"ring", "", "the ring just laid"},
      {"height_m", "m", "mean height of its bed joints"},
      {"blocks", "", "blocks laid so far"},
      {"verdict", "", "at the fresh friction of the case"},
      {"critical_friction", "", "fresh friction below which the stage does not stand; 0: it needs none"},
      {"critical_stands", "", "end of the bracket at which the stage stands"},
      {"critical_moves", "", "end of the bracket at which the stage moves"}};
  for (size_t row = 0; row < csv.rows.size(); ++row) {
    const int k = static_cast<int>(csv.number(row, ring));
    const double low = csv.number(row, moves), high = csv.number(row, stands);  // NaN without a bracket
    const double critical = high == 0.0 ? 0.0 : 0.5 * (low + high);
    t.rows.push_back({k, e.rings.at(static_cast<size_t>(k)).height, static_cast<int>(csv.number(row, blocks)),
                      csv.rows[row][verdict], critical, high, low});
  }
  return t;
}

std::optional<Figure> stage_figure(const Table& stages) {
  std::vector<std::vector<double>> rows;
  for (const auto& row : stages.rows) rows.push_back({std::get<double>(row[1]), std::get<double>(row[4])});
  if (std::none_of(rows.begin(), rows.end(), [](const auto& row) { return row[1] > 0.0; }))
    return std::nullopt;  // no stage needs friction, or none was searched
  Figure f;
  f.name = "stages";
  f.title = "Construction: friction required of the fresh mortar, ring by ring";
  f.caption =
      "The bed of the ring just laid has the friction of fresh mortar, all other joints have that of the "
      "case. The curve shows the fresh friction below which the vault built so far does not stand; 0 means "
      "that it needs none.";
  f.width = 900;
  f.height = 480;
  f.commands = plot_style() + data_block("stages", rows) +
               fmt::format(
                   "set xlabel 'height of the ring just laid (m)'\nset ylabel 'required friction'\nset "
                   "yrange [0:*]\nunset key\nplot $stages w lp lc rgb '{}' pt 7 ps 0.6 lw 2\n",
                   kBlue);
  return f;
}

}  // namespace cupola
