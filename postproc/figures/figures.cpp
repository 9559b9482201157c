#include "postproc/figures/figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/evaluation/meridians.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/shell_maps.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

/// True if the ring's figure shows anything but zeros.
bool shows_anything(const RingSum& ring) {
  return ring.cv_pressure > 0.0 || ring.largest_friction_use > 0.0 || ring.largest_kern > 0.0;
}

/// A row per ring. A blank one ends a line: where another member begins, or the other haunch of an arch, to
/// which the course at the crown belongs, too.
Rows ring_rows(const Evaluation& e) {
  Rows rows;
  const RingSum* last = nullptr;
  double step = 0.0;  // m, of the height from the ring before the last one
  for (const RingSum& r : e.rings) {
    if (r.blocks == 0) continue;
    const bool other = last && e.assembly.sheet_of(r.ring) != e.assembly.sheet_of(last->ring);
    const double next = last ? r.height - last->height : 0.0;
    const bool turns = !other && next * step < 0.0;
    if (other || turns) rows.emplace_back();
    if (turns) rows.push_back(rows[rows.size() - 2]);
    if (other || next != 0.0) step = other ? 0.0 : next;
    last = &r;
    rows.push_back({r.height, 100.0 * r.cv_pressure, 100.0 * r.largest_friction_use, r.largest_kern});
  }
  return rows;
}

}  // namespace

Figure ring_figure(const Evaluation& e) {
  const bool vault = is_vault(e);
  Figure f;
  f.name = "rings";
  f.title = vault ? "Rings over the height" : "Courses over the height";
  f.caption = fmt::format(
      "Left: how much the pressure on the beds of a {} varies from block to block (coefficient of "
      "variation). Right: the largest friction and kern use of a bed joint; beyond a kern use of 1, part of "
      "the joint is unloaded or pulls.",
      vault ? "ring" : "course");
  f.width = 1000;
  f.height = 420;
  f.commands =
      plot_style() + data_block("rings", ring_rows(e)) +
      panels(
          panel_grid(1, 2, {0.08, 0.97, 0.16, 0.92}, 0.1, 0.0),
          {fmt::format("unset key\nset ylabel 'height (m)'\nset xrange [0:0.1<*]\n"
                       "set xlabel 'variation of the bed pressure (%)'\n"
                       "plot $rings using 2:1 w lp lc rgb '{}' pt 7 ps 0.5 lw 1.5\n",
                       kBlue),
           fmt::format("set xlabel 'largest kern use; friction use (1 = 100 %)'\nset xrange [0:1.1<*]\n"
                       "set arrow from 1, graph 0 to 1, graph 1 nohead dt 3 lc rgb '#444444'\n"
                       "set key at graph 0.5,1.1 center top horizontal\n"
                       "plot $rings using ($3/100):1 w lp lc rgb '{}' pt 7 ps 0.5 lw 1.5 title 'friction', "
                       "$rings using 4:1 w lp lc rgb '{}' pt 5 ps 0.5 lw 1.5 title 'kern'\n",
                       kGreen, kPurple)});
  return f;
}

Figure hoop_figure(const MeridianEvaluation& m) {
  double largest = 0.0;
  for (const HoopRow& row : m.hoop) largest = std::max(largest, std::abs(row.sum()));
  const ForceUnit unit = force_unit(largest);
  Rows rows;
  for (const HoopRow& row : m.hoop)
    rows.push_back({row.height, unit.per_newton * row.head_force, unit.per_newton * row.bed_force,
                    unit.per_newton * row.sum()});
  Rows ties;
  for (const HoopRow& row : m.hoop)
    if (row.tie_force != 0.0) ties.push_back({row.height, unit.per_newton * row.tie_force});
  Figure f;
  f.name = "hoop_" + in_file_names(m.thrust.name);
  f.title = fmt::format("Hoop forces across the meridian {} ({:g} deg)", m.thrust.name, m.thrust.azimuth_deg);
  f.caption =
      "Hoop force of each ring across the meridian, compression positive. Dry head joints carry "
      "compression only; bed joints also carry tension, by friction.";
  if (!ties.empty()) f.caption += " Chains carry tension; the sum includes them.";
  f.width = 700;
  f.height = 480;
  f.commands =
      plot_style() + data_block("hoop", rows) + (ties.empty() ? "" : data_block("ties", ties)) +
      fmt::format(
          "set ylabel 'height (m)'\nset xlabel 'hoop force of a ring ({2}); tension < 0 < compression'\n"
          "set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb '#444444'\nset key outside right center\n"
          "plot $hoop using 2:1 w lp lc rgb '{0}' pt 5 ps 0.5 title 'head joints', "
          "$hoop using 3:1 w lp lc rgb '{1}' pt 9 ps 0.6 title 'bed joints', "
          "$hoop using 4:1 w lp lc rgb 'black' lw 2 pt 7 ps 0.5 title 'sum'{3}\n",
          kBlue, kOrange, unit.name,
          ties.empty()
              ? ""
              : fmt::format(", $ties using 2:1 w p lc rgb '{}' pt 13 ps 1.2 title 'chains'", kPurple));
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
      "Largest displacement and speed of a point of the blocks, relative to the ground, after "
      "each step, and the reaction of the supports over the weight of the free blocks.";
  f.width = 1000;
  f.height = 700;
  const auto curve = [](const std::string& settings, int column, const char* colour) {
    return fmt::format("{}plot $history using 1:{} w l lc rgb '{}' lw 2\n", settings, column, colour);
  };
  f.commands =
      plot_style() + data_block("history", rows) +
      panels(
          panel_grid(3, 1, {0.09, 0.97, 0.08, 0.97}, 0.0, 0.06),
          {curve(fmt::format("unset key\nset ylabel 'displacement ({})'\n", metres ? "m" : "mm"), 2, kBlue),
           curve("set ylabel 'speed (m/s)'\n", 3, kOrange),
           curve("set ylabel 'reaction / weight'\nset xlabel 'time (s)'\n", 4, kGreen)});
  return f;
}

std::vector<Figure> result_figures(const Evaluation& e, const std::vector<HistoryRow>& history) {
  std::vector<Figure> figures;
  const std::vector<ForceRange>& ranges = e.summary.ranges;
  if (!ranges.empty()) figures.push_back(range_figure(e));
  const std::vector<ShellMap> maps = shell_maps(e);
  if (std::any_of(ranges.begin(), ranges.end(), [](const ForceRange& r) { return r.joint.has_value(); }))
    for (const ShellMap& map : maps) figures.push_back(certainty_map(e, map));
  if (history.size() > 1) figures.push_back(history_figure(e, history));
  if (!at_rest(e)) return figures;
  for (const MeridianEvaluation& m : e.meridians)
    if (const auto points = std::ssize(m.thrust.points); points > 1 && m.thrust.undefined < points)
      figures.push_back(thrust_figure(e, m));
  if (std::any_of(e.rings.begin(), e.rings.end(), shows_anything)) figures.push_back(ring_figure(e));
  if (std::any_of(e.sections.begin(), e.sections.end(), [](const auto& s) { return !s.resultants.empty(); }))
    figures.push_back(levels_figure(e));
  for (const SectionEvaluation& section : e.sections)
    if (!section.polygons.empty()) figures.push_back(section_figure(e, section));
  for (const PlaneCut& cut : e.planes)
    if (!cut.polygons.empty()) figures.push_back(plane_figure(e, cut));
  for (const MeridianEvaluation& m : e.meridians)
    if (!m.hoop.empty()) figures.push_back(hoop_figure(m));
  if (has_chains_round(e)) figures.push_back(chain_figure(e));
  MapScales scales;
  for (const ShellMap& map : maps) scales.include(map);
  for (const ShellMap& map : maps)
    for (const Figure& figure : {force_map(map, scales), utilisation_map(map, scales), crack_map(e, map)})
      if (!figure.commands.empty()) figures.push_back(figure);
  return figures;
}

}  // namespace cupola
