#include "postproc/studies/tradeoff_figures.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "postproc/figures/plot_style.hpp"

namespace cupola {
namespace {

constexpr double kSmallestDrawnError = 1e-14;  // smaller errors, zero included, are drawn here
constexpr const char* kSeriesColours[] = {kBlue, kOrange,   kGreen,    kPurple,
                                          kSky,  "#E69F00", "#444444", "#999999"};
// Hollow point types of gnuplot: square, circle, triangle, downward triangle, diamond. Filled: the next
// number.
constexpr int kHollow[] = {4, 6, 8, 10, 12};

double drawn_error(const TradeoffRow& row) {
  return std::max(row.error(), kSmallestDrawnError);
}

/// The name of a knob or a run in words.
std::string words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// Names of the contact methods, in the order of ContactMethod; in brackets programs with one of the kind.
constexpr std::array kMethods{"Newton (SAP in Drake)",
                              "interior point",
                              "spectral gradient (SPG)",
                              "accelerated gradient (APGD, Chrono)",
                              "Gauss-Seidel (NSGS, Siconos, LMGC90)",
                              "splitting (ADMM, Siconos)"};
static_assert(kMethods.size() == enum_names(ContactMethod{}).size());

struct Series {
  std::string title;
  std::vector<TradeoffRow> rows;
};

/// Splits the runs of a knob into lines: runs whose names agree up to the last underscore, or that use the
/// same method.
std::vector<Series> series_of(const std::vector<TradeoffRow>& rows, bool by_method) {
  std::vector<Series> series;
  for (const TradeoffRow& row : rows) {
    const std::string& name = row.point.name;
    const std::string title =
        by_method ? kMethods[static_cast<size_t>(row.summary->method)] : name.substr(0, name.rfind('_'));
    auto at = std::find_if(series.begin(), series.end(), [&](const Series& s) { return s.title == title; });
    if (at == series.end()) at = series.insert(series.end(), {title, {}});
    at->rows.push_back(row);
  }
  return series;
}

std::string end_of_name(const std::string& name) {
  const size_t last = name.rfind('_');
  return last == std::string::npos ? name : name.substr(last + 1);
}

std::string axes(const std::vector<TradeoffRow>& rows) {
  const bool critical = !rows.empty() && rows.front().critical_error;
  const bool uses_wall_time = !rows.empty() && rows.front().uses_wall_time();
  return fmt::format("set ylabel '{}'\n",
                     critical ? "error of the critical value" : "error of the bed-joint wrenches, rms") +
         fmt::format("set xlabel '{} time of cupola-solve (s)'\n", uses_wall_time ? "wall" : "processor") +
         "set logscale xy\nset format y '10^{%T}'\nset termoption enhanced\nset key noenhanced\n";
}

/// Adds a series to the data and the plot command, with filled points for runs that reached their accuracy
/// and hollow points for the others; `line` joins the points.
void add_series(const Series& series, size_t number, bool line, std::string* data, std::string* plot) {
  std::vector<std::vector<double>> points, reached;
  for (const TradeoffRow& row : series.rows) {
    points.push_back({row.seconds(), drawn_error(row)});
    if (row.reached()) reached.push_back(points.back());
  }
  const char* colour = kSeriesColours[number % std::size(kSeriesColours)];
  const int shape = kHollow[number % std::size(kHollow)];
  const std::string name = fmt::format("series{}", number);
  *data += data_block(name, points);
  *plot += fmt::format("{} ${} w {} lc rgb '{}' pt {} ps 1.2 lw 1.4 title '{}'", plot->empty() ? "plot" : ",",
                       name, line ? "lp" : "p", colour, shape, gnuplot_text(words(series.title)));
  if (reached.empty()) return;
  *data += data_block(name + "_reached", reached);
  *plot += fmt::format(", ${}_reached w p lc rgb '{}' pt {} ps 1.2 notitle", name, colour, shape + 1);
}

std::string labels(const std::vector<TradeoffRow>& rows, bool whole_name) {
  std::string commands;
  for (const TradeoffRow& row : rows)
    commands += fmt::format(
        "set label '{}' at {:.9g},{:.9g} offset 0.7,0.6 noenhanced font ',9' textcolor rgb '#444444'\n",
        gnuplot_text(whole_name ? words(row.point.name) : end_of_name(row.point.name)), row.seconds(),
        drawn_error(row));
  return commands;
}

Figure knob_figure(const std::vector<TradeoffRow>& rows, const std::string& knob) {
  Figure figure;
  figure.name = "tradeoff_" + knob;
  figure.title = fmt::format("Error over time: {}", words(knob));
  figure.caption =
      "Each point is one run; hollow points did not reach the requested accuracy. Lower left is better.";
  if (knob.starts_with("method")) figure.caption += " All methods are implementations of this program.";
  std::string data, plot;
  size_t number = 0;
  for (const Series& series : series_of(rows, knob.starts_with("method")))
    add_series(series, number++, true, &data, &plot);
  figure.commands =
      plot_style() + axes(rows) + "set key outside right top\n" + labels(rows, false) + data + plot + "\n";
  return figure;
}

Figure overall_figure(const std::vector<TradeoffRow>& all) {
  Figure figure;
  figure.name = "tradeoff";
  figure.title = "Error over time: all settings";
  figure.caption =
      "Each run is compared with the reference of its setting: methods and tolerances with the same model "
      "solved to a tight tolerance, time steps with an extrapolation to zero, other settings with a finer "
      "model. The dashed line is the Pareto front of the methods. All methods are implementations of this "
      "program.";
  figure.width = 1100;
  figure.height = 700;
  std::string data, plot;
  size_t number = 0;
  for (const std::string& knob : knobs_of(all)) {
    const std::vector<TradeoffRow> rows = rows_of(all, knob);
    // A different kind of error or time cannot share the axes
    if (!rows.empty() && (rows.front().critical_error || rows.front().uses_wall_time())) continue;
    if (knob == "method") {
      for (const Series& series : series_of(rows, true)) add_series(series, number++, true, &data, &plot);
    } else if (!rows.empty()) {
      add_series({knob, rows}, number++, false, &data, &plot);
    }
  }
  const std::vector<TradeoffRow> front = pareto_front(rows_of(all, "method"));
  std::vector<std::vector<double>> steps;
  for (const TradeoffRow& row : front) steps.push_back({row.seconds(), drawn_error(row)});
  if (!steps.empty()) data += data_block("front", steps);
  if (!steps.empty())
    plot += ", $front w steps lc rgb '#000000' lw 0.8 dt 2 title 'Pareto front of the methods'";
  figure.commands =
      plot_style() + axes(front) + "set key outside right top\n" + labels(front, true) + data + plot + "\n";
  return figure;
}

}  // namespace

std::vector<Figure> tradeoff_figures(const std::vector<TradeoffRow>& rows) {
  std::vector<Figure> figures;
  for (const std::string& knob : knobs_of(rows))
    if (const std::vector<TradeoffRow> of_knob = rows_of(rows, knob); !of_knob.empty())
      figures.push_back(knob_figure(of_knob, knob));
  if (!figures.empty()) figures.insert(figures.begin(), overall_figure(rows));
  return figures;
}

}  // namespace cupola
