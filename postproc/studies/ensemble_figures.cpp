#include "postproc/studies/ensemble_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "postproc/figures/plot_style.hpp"
#include "postproc/tables/csv_file.hpp"

namespace cupola {
namespace {

constexpr std::array kEnsembleColours{kBlue, kOrange, kGreen, kPurple, kSky};
constexpr size_t kMostResults = 4;  // panels of the figure

/// Panels below each other, `height` px each.
void draw_below_each_other(const std::string& data, const std::string& settings,
                           const std::vector<std::string>& plots, int height, Figure* f) {
  f->width = 900;
  f->height = 60 + height * static_cast<int>(plots.size());
  f->commands = plot_style() + data + settings +
                panels(panel_grid(plots.size(), 1, {0.11, 0.97, 60.0 / f->height, 1.0 - 30.0 / f->height},
                                  0.0, 85.0 / f->height),
                       plots);
}

/// The table of bands of one table of the members, which all have its rows; three columns if no number
/// varies.
Table bands_table(const EnsembleResults& ensemble, const std::vector<CsvFile>& files,
                  const std::string& source) {
  constexpr size_t kKeys = 2;  // number and height
  const CsvFile& first = files.front();
  Table t{ensemble.name + "_bands_" + source, "Quantiles over the members that stand", {}, {}};
  for (size_t k = 0; k < kKeys; ++k) t.columns.push_back({first.columns[k], "", first.columns[k]});
  t.columns.push_back({"members", "", "members"});
  t.rows.resize(first.rows.size());
  for (size_t r = 0; r < first.rows.size(); ++r)
    t.rows[r] = {first.number(r, 0), first.number(r, 1), static_cast<int>(files.size())};
  for (size_t k = kKeys; k < first.columns.size(); ++k) {
    std::vector<std::vector<double>> values(first.rows.size());  // (rows x members)
    for (size_t r = 0; r < values.size(); ++r)
      for (const CsvFile& file : files) values[r].push_back(file.number(r, k));
    const auto varies = [](const std::vector<double>& v) {
      return std::ranges::any_of(v, [&v](double x) { return std::isfinite(x) && x != v.front(); });
    };
    if (std::ranges::none_of(values, varies)) continue;
    for (const auto& [key, p] : {std::pair("_q05", 0.05), {"_q50", 0.5}, {"_q95", 0.95}}) {
      t.columns.push_back({first.columns[k] + key, "", first.columns[k] + key});
      for (size_t r = 0; r < values.size(); ++r) t.rows[r].emplace_back(quantile_of({values[r], 0}, p).value);
    }
  }
  return t;
}

/// Index of the lowest quantile of a number of the bands; nothing if it does not vary.
std::optional<size_t> band_column(const Table& table, const std::string& number) {
  for (size_t k = 0; k < table.columns.size(); ++k)
    if (table.columns[k].key == number + "_q05") return k;
  return {};
}

/// What is drawn of a table of the members.
struct DrawnBand {
  const char *source, *number, *label;
};
constexpr std::array kDrawnBands{DrawnBand{"thrust_", "position", "thrust line (0 inside, 1 outside)"},
                                 DrawnBand{"hoop_", "hoop_force_N", "hoop force (N)"},
                                 DrawnBand{"rings", "mean_resultant_N", "mean force of a block (N)"}};

}  // namespace

Figure distribution_figure(const std::vector<EnsembleResults>& ensembles) {
  Figure f;
  f.name = "distributions";
  f.title = "Share of the members up to a value";
  f.caption =
      "Of a critical value up to which a structure stands (load, acceleration, tilt) the curve is the "
      "fragility: the share that falls at that value; of one that it needs (friction, thickness), the share "
      "that stands there.";
  std::vector<Table::Column> columns;
  for (const EnsembleResults& one : ensembles)
    for (const size_t k : one.results)
      if (std::ranges::count(columns, one.members.columns[k].key, &Table::Column::key) == 0)
        columns.push_back(one.members.columns[k]);
  if (columns.size() > kMostResults) columns.resize(kMostResults);
  std::string data;
  std::vector<std::string> plots;
  for (const Table::Column& column : columns) {
    std::string plot;
    for (size_t e = 0; e < ensembles.size(); ++e) {
      const std::optional<size_t> k = ensembles[e].result_named(column.key);
      if (!k) continue;
      std::vector<double> values = ensembles[e].values(*k).values;
      std::erase_if(values, [](double v) { return std::isnan(v); });
      std::ranges::sort(values);
      std::vector<std::vector<double>> rows;
      for (size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i]))
          rows.push_back({values[i], static_cast<double>(i + 1) / static_cast<double>(values.size())});
      if (rows.empty()) continue;
      const std::string block = fmt::format("column{}_{}", plots.size(), e);
      data += data_block(block, rows);
      plot +=
          fmt::format("{} ${} using 1:2 w steps lc rgb '{}' lw 1.5 title '{}'", plot.empty() ? "plot" : ",",
                      block, kEnsembleColours[e % kEnsembleColours.size()], gnuplot_text(ensembles[e].name));
    }
    if (plot.empty()) continue;
    plots.push_back(fmt::format("set xlabel '{}{}'\n",
                                gnuplot_text(column.meaning.substr(0, column.meaning.find(':'))),
                                column.unit.empty() ? "" : " (" + gnuplot_text(column.unit) + ")") +
                    plot + "\n");
  }
  if (plots.empty()) return f;
  draw_below_each_other(
      data, "set format x '%.6g'\nset yrange [0:1]\nset ylabel 'share of members'\nset key bottom right\n",
      plots, 280, &f);
  return f;
}

Figure convergence_figure(const EnsembleResults& ensemble) {
  constexpr size_t kFewest = 10, kPoints = 60;
  Figure f;
  f.name = ensemble.name + "_convergence";
  const size_t n = ensemble.falls.size();
  const std::optional<size_t> critical = ensemble.critical_column();
  const bool varies = critical ? !ensemble.censored() && std::ranges::count(ensemble.results, *critical) > 0
                               : ensemble.some_fall();
  if (!ensemble.independent() || n < kFewest || !varies) return f;
  f.title = critical ? "Mean critical value over the number of members"
                     : "Probability of falling over the number of members";
  f.caption =
      "Line: the estimate from the first members; band: its interval of 95 %. More members are needed while "
      "the band is wider than the answer may be.";
  std::vector<std::vector<double>> rows;
  const size_t step = std::max<size_t>(1, n / kPoints);
  for (size_t members = kFewest; members <= n; members += step) {
    if (members + step > n) members = n;  // the last point shows all
    const IntervalEstimate estimate =
        critical ? mean_of(ensemble.values(*critical, members)) : ensemble.probability(members);
    if (estimate.interval)
      rows.push_back(
          {static_cast<double>(members), estimate.value, estimate.interval->low, estimate.interval->high});
  }
  if (rows.size() < 2) return f;
  f.width = 900;
  f.height = 360;
  f.commands = plot_style() + data_block("estimate", rows) +
               fmt::format(
                   "set xlabel 'members'\nset ylabel '{}'\nset key top right\n"
                   "plot $estimate using 1:3:4 w filledcurves fc rgb '{}' fs transparent solid 0.3 title "
                   "'interval', $estimate using 1:2 w l lc rgb '{}' lw 2 title 'estimate'\n",
                   critical ? "mean critical value" : "probability of falling", kSky, kBlue);
  return f;
}

std::vector<Bands> bands_of(const EnsembleResults& ensemble, const std::string& runs_folder) {
  constexpr size_t kFewest = 10;
  namespace fs = std::filesystem;
  std::vector<fs::path> folders;
  for (size_t i = 0; i < ensemble.falls.size(); ++i)
    if (ensemble.falls[i] == 0)
      folders.push_back(fs::path(runs_folder) / ensemble.runs->runs[i].name / "post");
  std::vector<Bands> bands;
  if (folders.size() < kFewest || !fs::is_directory(folders.front())) return bands;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folders.front())) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".csv" &&
        (name == "rings" || name.starts_with("thrust_") || name.starts_with("hoop_")))
      names.push_back(name);
  }
  std::ranges::sort(names);
  for (const std::string& name : names) {
    std::vector<CsvFile> files;
    for (const fs::path& folder : folders)
      if (const fs::path file = folder / (name + ".csv"); fs::exists(file))
        files.push_back(read_csv(file.string()));
    // Members that differ in their number of beds cannot be put row beside row.
    std::erase_if(files, [&files](const CsvFile& file) {
      return file.rows.size() != files.front().rows.size() || file.columns != files.front().columns;
    });
    if (files.size() < kFewest || files.front().columns.size() < 3) continue;
    Table table = bands_table(ensemble, files, name);
    if (table.columns.size() > 3) bands.push_back({name, std::move(table)});
  }
  return bands;
}

Figure bands_figure(const std::vector<Bands>& bands) {
  Figure f;
  if (bands.empty()) return f;
  f.name = bands.front().table.name;
  f.title = "Thrust lines and forces of the members that stand";
  f.caption = "Line: median of each bed or ring; band: from the 5 % to the 95 % quantile.";
  std::string data;
  std::vector<std::string> plots;
  for (const DrawnBand& drawn : kDrawnBands)
    for (const Bands& band : bands) {
      const std::optional<size_t> column = band_column(band.table, drawn.number);
      if (!column || !band.source.starts_with(drawn.source)) continue;
      std::vector<std::vector<double>> rows;
      for (const auto& row : band.table.rows) {
        rows.emplace_back();
        for (const size_t k : {size_t{0}, *column, *column + 1, *column + 2})
          rows.back().push_back(std::get<double>(row[k]));
      }
      const std::string block = fmt::format("band{}", plots.size());
      data += data_block(block, rows);
      plots.push_back(fmt::format(
          "set xlabel '{5} ({0}.csv)' noenhanced\nset ylabel '{1}'\n"
          "plot ${2} using 1:2:4 w filledcurves fc rgb '{3}' fs transparent solid 0.3 title '5 to 95 %', "
          "${2} using 1:3 w l lc rgb '{4}' lw 2 title 'median'\n",
          gnuplot_text(band.source), drawn.label, block, kSky, kBlue,
          gnuplot_text(band.table.columns.front().key)));
    }
  if (plots.empty()) return f;
  draw_below_each_other(data, "set key top right\n", plots, 300, &f);
  return f;
}

}  // namespace cupola
