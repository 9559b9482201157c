#include "postproc/studies/study_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "postproc/figures/plot_style.hpp"

namespace cupola {
namespace {

constexpr double kLeastError = 1e-14;  // what is smaller, zero included, is drawn here
constexpr const char* kColours[] = {kBlue, kOrange, kGreen, kPurple, kSky, "#E69F00", "#444444", "#999999"};
// gnuplot's point types, hollow and filled, of one shape each: square, circle, triangle, downward, diamond
constexpr int kHollow[] = {4, 6, 8, 10, 12};

double drawn_error(const StudyRow& row) {
  return std::max(row.error(), kLeastError);
}

/// What other programs call the method, or solve with.
std::string peer(ContactMethod method) {
  static const std::map<ContactMethod, std::string> kPeers{
      {ContactMethod::newton, "Newton (as Drake's SAP)"},
      {ContactMethod::interior_point, "interior point, then Newton"},
      {ContactMethod::spg, "SPG (Chrono's BB)"},
      {ContactMethod::apgd, "APGD (Chrono)"},
      {ContactMethod::nsgs, "NSGS (Siconos; NLGS in LMGC90)"},
      {ContactMethod::admm, "ADMM (Siconos, Chrono)"}};
  return kPeers.at(method);
}

struct Series {
  std::string title;
  std::vector<StudyRow> rows;
};

/// Runs of one knob that belong on one line: those whose names agree up to the last underscore.
std::vector<Series> series_of(const std::vector<StudyRow>& rows, bool by_method) {
  std::vector<Series> series;
  for (const StudyRow& row : rows) {
    const std::string& name = row.point.name;
    const std::string title = by_method ? peer(row.summary->method) : name.substr(0, name.rfind('_'));
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

std::string axes(const std::vector<StudyRow>& rows) {
  const bool critical = !rows.empty() && rows.front().critical_error;
  const bool by_the_clock = !rows.empty() && rows.front().by_the_clock();
  return fmt::format("set ylabel '{}'\n",
                     critical ? "error of the critical value" : "error of the bed-joint wrenches, rms") +
         fmt::format("set xlabel '{} time of cupola-solve (s)'\n", by_the_clock ? "wall" : "processor") +
         "set logscale xy\nset format y '10^{%T}'\nset termoption enhanced\nset key noenhanced\n";
}

/// Adds a series to the data and to the plot command: a line, filled points where it was reached, hollow
/// ones where not.
void add_series(const Series& series, size_t number, bool line, std::string* data, std::string* plot) {
  std::vector<std::vector<double>> points, reached;
  for (const StudyRow& row : series.rows) {
    points.push_back({row.seconds(), drawn_error(row)});
    if (row.reached()) reached.push_back(points.back());
  }
  const char* colour = kColours[number % std::size(kColours)];
  const int shape = kHollow[number % std::size(kHollow)];
  const std::string name = fmt::format("series{}", number);
  *data += data_block(name, points);
  *plot += fmt::format("{} ${} w {} lc rgb '{}' pt {} ps 1.2 lw 1.4 title '{}'", plot->empty() ? "plot" : ",",
                       name, line ? "lp" : "p", colour, shape, gnuplot_text(series.title));
  if (reached.empty()) return;
  *data += data_block(name + "_reached", reached);
  *plot += fmt::format(", ${}_reached w p lc rgb '{}' pt {} ps 1.2 notitle", name, colour, shape + 1);
}

std::string labels(const std::vector<StudyRow>& rows, bool whole_name) {
  std::string commands;
  for (const StudyRow& row : rows)
    commands += fmt::format(
        "set label '{}' at {:.9g},{:.9g} offset 0.7,0.6 noenhanced font ',9' textcolor rgb '#444444'\n",
        gnuplot_text(whole_name ? row.point.name : end_of_name(row.point.name)), row.seconds(),
        drawn_error(row));
  return commands;
}

Figure knob_figure(const std::vector<StudyRow>& rows, const std::string& knob) {
  Figure figure;
  figure.name = "tradeoff_" + knob;
  figure.title = fmt::format("Time against wrench error: {}", knob);
  figure.caption =
      "Each point is a run, hollow where it did not reach what it asked for; low and left is better.";
  std::string data, plot;
  size_t number = 0;
  for (const Series& series : series_of(rows, knob.starts_with("method")))
    add_series(series, number++, true, &data, &plot);
  figure.commands =
      plot_style() + axes(rows) + "set key outside right top\n" + labels(rows, false) + data + plot + "\n";
  return figure;
}

Figure overall_figure(const std::vector<StudyRow>& all) {
  Figure figure;
  figure.name = "tradeoff";
  figure.title = "Time against wrench error: all knobs";
  figure.caption =
      "Each run against the reference of its knob: methods and tolerances against the same model solved "
      "tightly, other knobs against the finer model. The dashed line joins the methods' runs that no other "
      "beats.";
  figure.width = 1100;
  figure.height = 700;
  std::string data, plot;
  size_t number = 0;
  for (const std::string& knob : knobs_of(all)) {
    const std::vector<StudyRow> rows = rows_of(all, knob);
    // Another sort of error or of time
    if (!rows.empty() && (rows.front().critical_error || rows.front().by_the_clock())) continue;
    if (knob == "method") {
      for (const Series& series : series_of(rows, true)) add_series(series, number++, true, &data, &plot);
    } else if (!rows.empty()) {
      add_series({knob, rows}, number++, false, &data, &plot);
    }
  }
  const std::vector<StudyRow> front = pareto_front(rows_of(all, "method"));
  std::vector<std::vector<double>> steps;
  for (const StudyRow& row : front) steps.push_back({row.seconds(), drawn_error(row)});
  if (!steps.empty()) data += data_block("front", steps);
  if (!steps.empty()) plot += ", $front w steps lc rgb '#000000' lw 0.8 dt 2 title 'best of the methods'";
  figure.commands =
      plot_style() + axes(front) + "set key outside right top\n" + labels(front, true) + data + plot + "\n";
  return figure;
}

}  // namespace

std::vector<Figure> study_figures(const std::vector<StudyRow>& rows) {
  std::vector<Figure> figures;
  for (const std::string& knob : knobs_of(rows))
    if (const std::vector<StudyRow> of_knob = rows_of(rows, knob); !of_knob.empty())
      figures.push_back(knob_figure(of_knob, knob));
  if (!figures.empty()) figures.insert(figures.begin(), overall_figure(rows));
  return figures;
}

}  // namespace cupola
