#include "postproc/figures/figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/shell_maps.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

}  // namespace

Figure ring_figure(const Evaluation& e) {
  const ForceUnit unit = force_unit(e.rings.front().load_above.norm());
  Rows rows;
  for (const RingSum& r : e.rings)
    rows.push_back({r.height, unit.per_newton * r.joint_force.dot(e.up),
                    unit.per_newton * r.load_above.dot(-e.up), std::max(r.relative_difference, 1e-17),
                    r.cv_resultant, r.cv_pressure, r.largest_friction_use, r.largest_kern});
  Figure f;
  f.name = "rings";
  f.title = "Ring cuts";
  f.caption =
      "Vertical sum of the joint forces below each ring and the load above it; their relative difference; "
      "the coefficient of variation of the block resultants and bed pressures; and the largest friction and "
      "kern utilisation of the bed joints. Above a kern utilisation of 1, part of the joint is unloaded.";
  f.width = 1100;
  f.height = 760;
  f.commands =
      plot_style() + data_block("rings", rows) +
      fmt::format(
          "set multiplot layout 2,2 margins 0.10,0.97,0.09,0.96 spacing 0.12,0.11\nset xlabel 'height (m)'\n"
          "set key at graph 0.5,1.0 center bottom horizontal\n"
          "set ylabel 'vertical force ({4})'\nset yrange [0:*]\n"
          "plot $rings using 1:3 w l lc rgb '{0}' lw 3 title 'load above', $rings using 1:2 w p lc rgb '{1}' "
          "pt 7 ps 0.6 title 'joint forces'\n"
          "set ylabel 'relative difference'\nset logscale y\nset format y '10^{{%T}}'\nset yrange [*:*]\nset "
          "termoption enhanced\n"
          "plot $rings using 1:4 w lp lc rgb '{0}' pt 7 ps 0.5 notitle\nset termoption noenhanced\nunset "
          "logscale y\nset format y '%g'\n"
          "set ylabel 'coefficient of variation'\nset yrange [0:0.001<*]\n"
          "plot $rings using 1:5 w lp lc rgb '{0}' pt 7 ps 0.5 title 'block resultants', $rings using 1:6 w "
          "lp lc rgb '{1}' pt 5 ps 0.5 title 'bed pressures'\n"
          "set ylabel 'largest utilisation of a bed joint'\nset yrange [0:*]\n"
          "plot $rings using 1:7 w lp lc rgb '{2}' pt 7 ps 0.5 title 'friction', $rings using 1:8 w lp lc "
          "rgb '{3}' pt 5 ps 0.5 title 'kern', 1 w l lc rgb '#444444' dt 3 notitle\n"
          "unset multiplot\n",
          kBlue, kOrange, kGreen, kPurple, unit.name);
  return f;
}

Figure hoop_figure(const MeridianEvaluation& m) {
  double largest = 0.0;
  for (const HoopRow& row : m.hoop) largest = std::max(largest, std::abs(row.head_force + row.bed_force));
  const ForceUnit unit = force_unit(largest);
  Rows rows;
  for (const HoopRow& row : m.hoop)
    rows.push_back({row.height, unit.per_newton * row.head_force, unit.per_newton * row.bed_force,
                    unit.per_newton * (row.head_force + row.bed_force)});
  Figure f;
  f.name = "hoop_" + m.thrust.name;
  f.title = fmt::format("Hoop forces across the meridian {} ({:g} deg)", m.thrust.name, m.thrust.azimuth_deg);
  f.caption =
      "Hoop force of each ring across the meridian, compression positive. Dry head joints carry "
      "compression only; bed joints also carry tension, by friction.";
  f.width = 900;
  f.height = 480;
  f.commands =
      plot_style() + data_block("hoop", rows) +
      fmt::format(
          "set xlabel 'height (m)'\nset ylabel 'hoop force of a ring ({2})'\n"
          "set xzeroaxis lc rgb '#444444'\nset key left top\n"
          "plot $hoop using 1:4 w lp lc rgb 'black' lw 2 pt 7 ps 0.5 title 'sum', $hoop using 1:2 w lp lc "
          "rgb '{0}' pt 5 ps 0.5 title 'head joints', $hoop using 1:3 w lp lc rgb '{1}' pt 9 ps 0.6 title "
          "'bed joints'\n",
          kBlue, kOrange, unit.name);
  return f;
}

Figure history_figure(const Evaluation& e, const std::vector<HistoryRow>& history) {
  double largest = 0.0;
  for (const HistoryRow& row : history) largest = std::max(largest, row.max_displacement);
  const bool metres = largest >= 1.0;
  Rows rows;
  for (const HistoryRow& row : history)
    rows.push_back({row.time, (metres ? 1.0 : 1e3) * row.max_displacement, row.max_speed,
                    e.summary.weight_N > 0.0 ? row.reaction / e.summary.weight_N : 0.0});
  Figure f;
  f.name = "history";
  f.title = "Motion over time";
  f.caption =
      "Largest displacement and speed of a block after each step, and the reaction of the supports over the "
      "weight of the free blocks.";
  f.width = 1000;
  f.height = 700;
  f.commands = plot_style() + data_block("history", rows) +
               fmt::format(
                   "set multiplot layout 3,1 margins 0.09,0.97,0.08,0.97 spacing 0.06\nunset key\n"
                   "set ylabel 'displacement ({3})'\nplot $history using 1:2 w l lc rgb '{0}' lw 2\n"
                   "set ylabel 'speed (m/s)'\nplot $history using 1:3 w l lc rgb '{1}' lw 2\n"
                   "set ylabel 'reaction / weight'\nset xlabel 'time (s)'\nplot $history using 1:4 w l lc "
                   "rgb '{2}' lw 2\n"
                   "unset multiplot\n",
                   kBlue, kOrange, kGreen, metres ? "m" : "mm");
  return f;
}

std::vector<Figure> result_figures(const Evaluation& e, const std::vector<HistoryRow>& history,
                                   const std::vector<Shot>& shots) {
  std::vector<Figure> figures;
  const std::vector<ForceRange>& ranges = e.summary.ranges;
  if (!ranges.empty()) figures.push_back(range_figure(e));
  if (e.shell.num_rings() > 0 &&
      std::any_of(ranges.begin(), ranges.end(), [](const ForceRange& r) { return r.joint.has_value(); }))
    figures.push_back(certainty_map(e));
  if (!shots.empty()) figures.push_back(motion_figure(e, shots));
  if (history.size() > 1) figures.push_back(history_figure(e, history));
  if (!at_rest(e.summary)) return figures;
  for (const MeridianEvaluation& m : e.meridians)
    if (m.thrust.points.size() > 1) figures.push_back(thrust_figure(e, m));
  if (!e.rings.empty()) figures.push_back(ring_figure(e));
  if (std::any_of(e.sections.begin(), e.sections.end(), [](const auto& s) { return !s.resultants.empty(); }))
    figures.push_back(levels_figure(e));
  for (const SectionEvaluation& section : e.sections)
    if (!section.polygons.empty()) figures.push_back(section_figure(e, section));
  for (const PlaneCut& cut : e.planes)
    if (!cut.polygons.empty()) figures.push_back(plane_figure(e, cut));
  for (const MeridianEvaluation& m : e.meridians)
    if (!m.hoop.empty()) figures.push_back(hoop_figure(m));
  if (e.shell.num_rings() > 0) {
    const ShellMap map = shell_map(e);
    MapScales scales;
    scales.include(map);
    figures.push_back(force_map(map, scales));
    figures.push_back(utilisation_map(map, scales));
  }
  return figures;
}

}  // namespace cupola
