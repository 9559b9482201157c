#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/range_text.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr size_t kMostBars = 30;
constexpr double kBar = 0.2, kMark = 0.36;  // half heights, in rows

/// The ranges read in one unit, with the limits of their common axis, in that unit.
struct RangePanel {
  RangeUnit unit;
  std::vector<const ForceRange*> ranges;
  double low = 0.0, high = 0.0;                         // zero lies on every axis
  double reach() const { return 0.16 * (high - low); }  // room for numbers and arrows beyond the bars
};

std::vector<RangePanel> panels_of(const std::vector<ForceRange>& ranges) {
  std::vector<RangePanel> panels;
  for (size_t i = 0; i < std::min(ranges.size(), kMostBars); ++i) {
    const RangeUnit unit = range_unit(ranges[i]);
    auto panel = std::find_if(panels.begin(), panels.end(),
                              [&unit](const RangePanel& p) { return p.unit.name == unit.name; });
    if (panel == panels.end()) panel = panels.insert(panel, {unit, {}});
    panel->ranges.push_back(&ranges[i]);
    for (const std::optional<double>& value : {ranges[i].min.value, ranges[i].chosen, ranges[i].max.value}) {
      panel->low = std::min(panel->low, unit.per_si * value.value_or(0.0));
      panel->high = std::max(panel->high, unit.per_si * value.value_or(0.0));
    }
  }
  for (RangePanel& panel : panels)
    if (panel.low == panel.high) {
      panel.low = -1.0;
      panel.high = 1.0;
    }
  return panels;
}

std::string number_label(const std::string& text, double x, double y, const char* where) {
  return fmt::format("set label '{}' at {},{} {}\n", gnuplot_text(text), x, y, where);
}

/// The bars, marks and arrows of a panel as data blocks, and its numbers as labels. The first range is on
/// top.
std::string panel_data(const RangePanel& panel) {
  Rows bars, marks, arrows;
  std::string labels;
  double y = static_cast<double>(panel.ranges.size());
  for (const ForceRange* range : panel.ranges) {
    const double from = least(*range), to = greatest(*range), scale = panel.unit.per_si;
    // An end without a value is drawn at the next value known.
    const auto known = [&](double end, double other) {
      return std::isfinite(end) ? end : range->chosen.value_or(std::isfinite(other) ? other : 0.0);
    };
    const double left = std::isinf(from) ? panel.low : scale * known(from, to);
    const double right = std::isinf(to) ? panel.high : scale * known(to, from);
    bars.push_back({0.5 * (left + right), y, left, right, y - kBar, y + kBar});
    if (std::isinf(from)) arrows.push_back({left, y, -0.8 * panel.reach(), 0.0});
    if (std::isinf(to)) arrows.push_back({right, y, 0.8 * panel.reach(), 0.0});
    const auto text = [&](double value, const RangeEnd& end) {
      const std::string number = std::isfinite(value) ? range_number(value, *range) : "";
      return end.outcome == RangeOutcome::unconverged ? number + "?" : number;
    };
    if (std::isinf(from) == 0) labels += number_label(text(from, range->min), left, y, "right offset -0.6,0");
    if (std::isinf(to) == 0) labels += number_label(text(to, range->max), right, y, "left offset 0.6,0");
    if (range->chosen) {
      marks.push_back({scale * *range->chosen, y - kMark, 0.0, 2.0 * kMark});
      labels += number_label(range_number(*range->chosen, *range), scale * *range->chosen, y + kMark,
                             fmt::format("center offset 0,0.5 tc rgb '{}'", kOrange).c_str());
    }
    y -= 1.0;
  }
  return data_block("bars", bars) + data_block("marks", marks) + data_block("arrows", arrows) + labels;
}

/// Names of the quantities beside their bars, the axis in the unit of the panel, and for forces that are not
/// small against the weight a second axis on top.
std::string panel_axes(const RangePanel& panel, double weight) {
  std::string tics;
  double y = static_cast<double>(panel.ranges.size());
  for (const ForceRange* range : panel.ranges) {
    tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", gnuplot_text(range_name(*range)), y);
    y -= 1.0;
  }
  const double left = panel.low - panel.reach(), right = panel.high + panel.reach();
  std::string axes = fmt::format(
      "set xrange [{}:{}]\nset yrange [0.4:{}]\nset ytics ({})\nset xlabel '{}'\n"
      "set arrow from 0,graph 0 to 0,graph 1 nohead lc rgb '#444444'\n",
      left, right, static_cast<double>(panel.ranges.size()) + 1.0, tics,
      panel.unit.name.empty() ? "ratio" : panel.unit.name);
  constexpr double kSmall = 0.01;
  const double per_weight = weight > 0.0 ? 1.0 / (panel.unit.per_si * weight) : 0.0;
  const bool forces = panel.ranges.front()->unit == "N";
  if (!forces || std::max(-panel.low, panel.high) * per_weight < kSmall)
    return axes + "unset x2tics\nunset x2label\n";
  return axes + fmt::format("set x2range [{}:{}]\nset x2tics\nset x2label 'times the weight' offset 0,-0.3\n",
                            left * per_weight, right * per_weight);
}

/// Draws the data of a panel; the first one has the key.
std::string panel_plot(const RangePanel& panel, bool first) {
  const bool chosen = std::any_of(panel.ranges.begin(), panel.ranges.end(),
                                  [](const ForceRange* r) { return r->chosen.has_value(); });
  const bool open = std::any_of(panel.ranges.begin(), panel.ranges.end(), [](const ForceRange* r) {
    return std::isinf(least(*r)) || std::isinf(greatest(*r));
  });
  std::string plot = fmt::format("plot $bars w boxxyerror fs solid 0.7 border lc rgb '{}' lc rgb '{}' {}",
                                 kBlue, kSky, first ? "title 'all admissible states'" : "notitle");
  if (chosen)
    plot += fmt::format(", $marks w vectors nohead lw 4 lc rgb '{}' {}", kOrange,
                        first ? "title 'chosen by the compliances'" : "notitle");
  if (open)
    plot +=
        fmt::format(", $arrows w vectors head size screen 0.012,25 nofilled lw 2 lc rgb '{}' notitle", kBlue);
  return plot + "\n";
}

}  // namespace

Figure range_figure(const Evaluation& e) {
  constexpr int kRow = 46, kAxes = 104, kKey = 34;  // px
  const std::vector<RangePanel> groups = panels_of(e.summary.ranges);
  size_t longest = 0;
  int height = kKey;
  for (const RangePanel& panel : groups) {
    for (const ForceRange* range : panel.ranges) longest = std::max(longest, range_name(*range).size());
    height += kRow * static_cast<int>(panel.ranges.size()) + kAxes;
  }
  Figure f;
  f.name = "ranges";
  f.title = "Ranges over all admissible states";
  f.caption =
      "Bars: from the smallest to the largest value over all forces that balance the loads within the joint "
      "laws. Every force state in which the blocks can stand lies inside them, whatever its history. Marks: "
      "the state that the compliances choose. An arrow marks an end without limit, a question mark an end "
      "whose search did not converge.";
  if (e.summary.ranges.size() > kMostBars)
    f.caption += fmt::format(" The first {} of {} quantities are drawn.", kMostBars, e.summary.ranges.size());
  f.width = 1000;
  f.height = height;
  const double left = std::min(0.45, (7.5 * static_cast<double>(longest) + 25.0) / f.width);
  std::vector<PanelBox> boxes;
  std::vector<std::string> plots;
  double top = kKey;
  for (const RangePanel& panel : groups) {
    const double axes_top = top + 0.5 * kAxes - 4, bars = kRow * static_cast<double>(panel.ranges.size());
    boxes.push_back({left, 0.97, 1.0 - (axes_top + bars) / height, 1.0 - axes_top / height});
    plots.push_back("unset label\nunset arrow\n" + panel_data(panel) + panel_axes(panel, e.summary.weight_N) +
                    panel_plot(panel, &panel == &groups.front()));
    top += bars + kAxes;
  }
  f.commands = plot_style() +
               fmt::format(
                   "set border 1\nset tics nomirror\nset style fill solid\n"
                   "set key at screen 0.5,{} center center horizontal\n",
                   1.0 - 0.5 * kKey / height) +
               panels(boxes, plots);
  return f;
}

}  // namespace cupola
