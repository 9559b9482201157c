#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "postproc/evaluation/meridians.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/wythe_curves.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Range of values; widen() adds a margin of 3 % and makes an empty range positive.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void widen() {
    const double margin = std::max(0.03 * (high - low), 1e-9);
    low -= margin;
    high += margin;
  }
};

/// The points of a thrust line, interrupted where its position is undefined.
Rows line_rows(const ThrustLine& line) {
  Rows rows;
  for (const ThrustPoint& p : line.points)
    rows.push_back(p.is_placed() ? std::vector{profile_abscissa(line, p.point), p.point.z()}
                                 : std::vector<double>{});
  return rows;
}

/// Data blocks of a thrust figure: skins, beds, thrust lines, lines of action, envelope, graphs.
std::string thrust_data(const MeridianEvaluation& m, const ForceUnit& unit) {
  const ThrustLine& line = m.thrust;
  const auto at = [&](const Vec3& p) { return std::vector{profile_abscissa(line, p), p.z()}; };
  Rows skins[2], thirds[2], beds, action, envelope, graphs, pressed;
  double longest = 0.0;
  for (const ThrustPoint& p : line.points) longest = std::max(longest, p.r);
  for (const ThrustPoint& p : line.points) {
    skins[0].push_back(at(p.intrados));
    skins[1].push_back(at(p.extrados));
    for (const int i : {0, 1})
      thirds[i].push_back(at(p.intrados + (i + 1) / 3.0 * (p.extrados - p.intrados)));
    beds.insert(beds.end(), {at(p.intrados), at(p.extrados), {}});
    if (std::isfinite(p.pressure))
      for (const double position : {p.compressed_from, p.compressed_to}) {
        pressed.push_back(at(p.intrados + position * (p.extrados - p.intrados)));
        pressed.back().push_back(1e-6 * p.pressure);
        if (position == p.compressed_to) pressed.emplace_back();
      }
    if (p.is_placed()) {
      const double thickness = (p.extrados - p.intrados).norm();
      const Vec3 reach = longest > 0.0 ? Vec3(1.5 * thickness / longest * p.force) : Vec3(Vec3::Zero());
      action.insert(action.end(), {at(p.point - reach), at(p.point + reach), {}});
    }
    graphs.push_back({line.arch ? profile_abscissa(line, 0.5 * (p.intrados + p.extrados)) : p.height(),
                      unit.per_newton * p.r, unit.per_newton * p.v, p.couple_length, p.face_distance});
  }
  for (const Vec3& p : line.envelope) envelope.push_back(at(p));
  std::string ends;
  if (m.least_thrust) ends += data_block("least", line_rows(*m.least_thrust));
  if (m.greatest_thrust) ends += data_block("greatest", line_rows(*m.greatest_thrust));
  return data_block("intrados", skins[0]) + data_block("extrados", skins[1]) +
         data_block("inner", thirds[0]) + data_block("outer", thirds[1]) + data_block("beds", beds) +
         data_block("thrust", line_rows(line)) + data_block("action", action) +
         data_block("envelope", envelope) + data_block("graphs", graphs) + data_block("pressed", pressed) +
         ends;
}

/// Largest mean pressure of a compressed zone, Pa; 0 without any.
double largest_zone_pressure(const ThrustLine& line) {
  double largest = 0.0;
  for (const ThrustPoint& p : line.points) largest = std::fmax(largest, p.pressure);  // skips NaN
  return largest;
}

/// The section of the wythes with their thrust lines and that of the whole thickness.
std::string wythe_profile(const WytheCurves& wythes) {
  return fmt::format(
      "plot {}$intrados w l lc rgb 'black' lw 1.5 notitle, $extrados w l lc rgb 'black' lw 1.5 notitle{}, "
      "$thrust w lp lc rgb '{}' lw 2 pt 7 ps 0.5 title 'whole thickness'\n",
      wythes.section, wythes.lines, kOrange);
}

std::string profile_plot(const MeridianEvaluation& m, const Summary& summary, bool zones) {
  std::string title = "thrust line";
  if (!summary.ranges.empty()) title += has_chosen(summary.ranges) ? " (chosen)" : " (one state)";
  std::string ends;
  if (m.least_thrust) ends += fmt::format(", $least w l lc rgb '{}' lw 1.2 title 'least thrust'", kBlue);
  if (m.greatest_thrust)
    ends += fmt::format(", $greatest w l lc rgb '{}' lw 1.2 title 'greatest thrust'", kPurple);
  // From light to dark by pressure.
  const std::string pressed = zones ? "$pressed w l lc palette lw 5 title 'compressed', " : "";
  return fmt::format(
      "set palette defined (0 '#fde0c5', 1 '#a03060')\nset cbrange [0:*]\nunset colorbox\n"
      "plot $beds w l lc rgb '#dddddd' lw 0.7 notitle, {5}$inner w l lc rgb '#888888' dt 3 lw 1.2 title "
      "'middle third', $outer w l lc rgb '#888888' dt 3 lw 1.2 notitle, "
      "$intrados w l lc rgb 'black' lw 1.5 title 'intrados, extrados', "
      "$extrados w l lc rgb 'black' lw 1.5 notitle, $action w l lc rgb '{2}' lw 1 title 'lines of action', "
      "$envelope w l lc rgb '{1}' lw 1.5 dt 2 title 'envelope', "
      "$thrust w lp lc rgb '{0}' lw 2 pt 7 ps 0.5 title '{3}'{4}\n",
      kOrange, kGreen, kSky, title, ends, pressed);
}

/// Gnuplot command for at most `most` steps between the tick marks of an axis: narrow panels have no room for
/// more. `length`: of the axis.
std::string few_ticks(char axis, double length, double most) {
  if (!(length > 0.0)) return fmt::format("set {}tics auto\n", axis);
  const double least = length / most, power = std::pow(10.0, std::floor(std::log10(least)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (step < least) step = factor * power;
  return fmt::format("set {}tics {}\n", axis, step);
}

/// Largest values of the graphs beside or below the profile.
struct GraphRanges {
  double resultant = 0.0;  // in the unit of the figure
  double couple = 0.0;     // m
  double distance = 0.0;   // m, from a face
  double outside = 0.0;    // m, beyond a face
};

GraphRanges graph_ranges(const ThrustLine& line, const ForceUnit& unit) {
  GraphRanges out;
  for (const ThrustPoint& p : line.points) {  // skips NaN
    out.resultant = std::fmax(out.resultant, unit.per_newton * p.r);
    out.couple = std::fmax(out.couple, p.couple_length);
    out.distance = std::fmax(out.distance, p.face_distance);
    out.outside = std::fmax(out.outside, -p.face_distance);
  }
  return out;
}

/// Where the legend of a profile begins that has its end at the foot of the line, m. `low`: m, lowest height
/// shown.
double left_of_foot(const ThrustLine& line, double low, double pixels_per_metre) {
  constexpr double kWidth = 215.0, kHeight = 130.0;  // pixels, of the legend
  double foot = std::numeric_limits<double>::infinity();
  for (const ThrustPoint& p : line.points)
    if (p.intrados.z() < low + kHeight / pixels_per_metre)
      for (const Vec3& q : {p.intrados, p.extrados, p.is_placed() ? p.point : p.intrados})
        foot = std::min(foot, profile_abscissa(line, q));
  return foot - kWidth / pixels_per_metre;
}

/// The end of the axis of couple lengths, which spans at least `least`, m: rounding fills no panel.
std::string end_of_couples(double largest, double least, const WytheCurves& wythes) {
  return largest > least || !wythes.couple.empty() ? "*" : fmt::to_string(least);
}

/// Four panels with a common height axis: profile, resultant, couple length, distance to the nearer face.
std::string vault_panels(const MeridianEvaluation& m, int width, int height, const ForceUnit& unit,
                         const std::string& profile, const WytheCurves& wythes) {
  const size_t rows = m.thrust.points.size();
  Range x, z;
  for (const ThrustLine* line : {&m.thrust, m.least_thrust ? &*m.least_thrust : nullptr,
                                 m.greatest_thrust ? &*m.greatest_thrust : nullptr}) {
    if (line == nullptr) continue;
    for (const ThrustPoint& p : line->points)
      for (const Vec3& q : {p.intrados, p.extrados, p.is_placed() ? p.point : p.intrados}) {
        x.add(profile_abscissa(*line, q));
        z.add(q.z());
      }
  }
  z.widen();
  x.widen();
  constexpr double kLeastCouple = 0.2, kSteps = 5.0;  // m, range of the panel; steps between tick marks
  const GraphRanges graphs = graph_ranges(m.thrust, unit);
  const double couple = std::max(kLeastCouple, graphs.couple);
  // Both axes of the profile have the same scale: the height of the panel in pixels sets its width.
  constexpr double kBottom = 0.10, kTop = 0.93, kLeft = 0.07;
  const double pixels_per_metre = (kTop - kBottom) * height / (z.high - z.low);
  x.low = std::min(x.low, left_of_foot(m.thrust, z.low, pixels_per_metre));
  const double right = std::min(0.50, kLeft + (x.high - x.low) * pixels_per_metre / width);
  x.high = std::max(x.high, x.low + (right - kLeft) * width / pixels_per_metre);
  const double gap = 0.045;
  std::vector<PanelBox> boxes = panel_grid(1, 3, {right + gap, 0.98, kBottom, kTop}, gap, 0.0);
  boxes.insert(boxes.begin(), {kLeft, right, kBottom, kTop});
  return panels(
      boxes,
      {fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset xlabel 'distance from the axis (m)'\n"
                   "set ylabel 'height (m)'\nset key at graph 0.02,0.02 left bottom\n",
                   x.low, x.high, z.low, z.high) +
           profile,
       fmt::format("{5}set xrange [0:*]\nset xlabel 'resultant ({2})'\nunset ylabel\n"
                   "plot $graphs using 2:1 w lp lc rgb '{0}' pt 7 ps 0.4 notitle, $graphs using 3:1 w l lc "
                   "rgb '{1}' dt 2 lw 2 notitle{3}{4}{6}\n",
                   kBlue, kOrange, unit.name,
                   curve_label("graphs", rows / 2, "$2", "$1", "r: norm", kBlue, "left offset 1.2,0"),
                   curve_label("graphs", rows / 4, "$3", "$1", "v: vertical", kOrange, "right offset -1.2,0"),
                   few_ticks('x', graphs.resultant, kSteps), wythes.resultant),
       fmt::format("{}set xlabel 'couple length (m)'\nset xrange [0:{}]\n"
                   "plot $graphs using 4:1 w lp lc rgb '{}' pt 7 ps 0.4 notitle{}\n",
                   few_ticks('x', couple, kSteps), end_of_couples(graphs.couple, kLeastCouple, wythes),
                   kPurple, wythes.couple),
       fmt::format("{}set xlabel 'distance to the nearer face (m)'\nset xrange [*<0:*]\n"
                   "plot $graphs using 5:1 w lp lc rgb '{}' pt 7 ps 0.4 notitle{}\n",
                   few_ticks('x', graphs.distance + graphs.outside, kSteps), kGreen, wythes.distance)});
}

/// Profile on top; below it resultant, couple length and distance to the nearer face, over x.
std::string arch_panels(const MeridianEvaluation& m, const ForceUnit& unit, const std::string& profile,
                        const WytheCurves& wythes) {
  constexpr double kLeastCouple = 1e-3, kSteps = 4.0;  // m, range of the panel; steps between tick marks
  const GraphRanges graphs = graph_ranges(m.thrust, unit);
  const double couple = std::max(kLeastCouple, graphs.couple);
  const auto band = [](double bottom, double top) { return PanelBox{0.09, 0.97, bottom, top}; };
  return panels(
      {band(0.57, 0.95), band(0.41, 0.51), band(0.245, 0.345), band(0.08, 0.18)},
      {"set size ratio -1\nset ylabel 'height (m)'\nset key at screen 0.5,0.995 center top horizontal\n" +
           profile,
       fmt::format(
           "{4}set size noratio\nset key at graph 0.5,1.02 center bottom horizontal\nset ylabel 'resultant "
           "({2})'\nset yrange [0:*]\n"
           "plot $graphs using 1:2 w lp lc rgb '{0}' pt 7 ps 0.4 title 'r: norm', "
           "$graphs using 1:(abs($3)) w l lc rgb '{1}' dt 2 title 'v: vertical'{3}\n",
           kBlue, kOrange, unit.name, wythes.resultant, few_ticks('y', graphs.resultant, kSteps)),
       fmt::format("{}set ylabel 'couple length (m)'\nset yrange [0:{}]\n"
                   "plot $graphs using 1:4 w lp lc rgb '{}' pt 7 ps 0.4 notitle{}\n",
                   few_ticks('y', wythes.couple.empty() ? couple : 0.0, kSteps),
                   end_of_couples(graphs.couple, kLeastCouple, wythes), kPurple, wythes.couple),
       fmt::format("{}set xlabel 'x (m)'\nset ylabel 'to face (m)'\nset yrange [*<0:*]\n"
                   "plot $graphs using 1:5 w lp lc rgb '{}' pt 7 ps 0.4 notitle{}\n",
                   few_ticks('y', graphs.distance + graphs.outside, kSteps), kGreen, wythes.distance)});
}

}  // namespace

Figure thrust_figure(const Evaluation& e, const MeridianEvaluation& m) {
  const ThrustLine& line = m.thrust;
  const bool arch = line.arch;
  const double couple = line.largest_couple_length();
  double largest = 0.0;
  for (const ThrustPoint& p : line.points) {
    largest = std::max(largest, p.r);
  }
  const ForceUnit unit = force_unit(largest);
  Figure f;
  f.name = "thrust_" + in_file_names(line.name);
  f.title = arch ? "Thrust line of " + (line.name == kOnlyArch ? "the arch" : line.name)
                 : fmt::format("Thrust line, meridian {} ({:g} deg)", line.name, line.azimuth_deg);
  f.caption =
      describe(line) +
      fmt::format(
          " r is the norm of the resultant of {} across a bed, v its vertical component. The largest couple "
          "length of such a resultant is {}.",
          arch ? "the full width" : "a strip one block wide", length_text(couple));
  if (m.least_thrust || m.greatest_thrust)
    f.caption +=
        " The thin lines belong to the states of least and greatest thrust among all admissible ones.";
  const double pressure = largest_zone_pressure(line);
  const bool zones = e.scene.joints.have_strength() && pressure > 0.0;
  if (zones)
    f.caption += fmt::format(
        " The thick parts of the beds push, darker where the mean pressure of these parts is higher, at most "
        "{:.3g} MPa.",
        1e-6 * pressure);
  const WytheCurves wythes = wythe_curves(e, m, unit);
  if (!m.wythes.empty())
    f.caption +=
        " Shaded: the blocks that the plane of the meridian cuts. The line of a wythe takes the beds that "
        "lie in it alone; where a bonder rests on another, only the whole thickness has a line.";
  f.width = 1200;
  f.height = arch ? 900 : 560;
  const std::string profile = m.wythes.empty() ? profile_plot(m, e.summary, zones) : wythe_profile(wythes);
  f.commands = plot_style() + thrust_data(m, unit) + wythes.data +
               (arch ? arch_panels(m, unit, profile, wythes)
                     : vault_panels(m, f.width, f.height, unit, profile, wythes));
  return f;
}

}  // namespace cupola
