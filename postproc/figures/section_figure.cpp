#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/evaluation/sections.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/tables/mesh_output.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Closed outlines of the cut blocks, separated by blank rows.
Rows outlines_of(const SectionEvaluation& section) {
  Rows rows;
  for (const CutPolygon& polygon : section.polygons) {
    for (const Vec3& p : polygon.outline) rows.push_back({p.x(), p.y()});
    rows.push_back({polygon.outline.front().x(), polygon.outline.front().y()});
    rows.push_back({});
  }
  return rows;
}

/// Resultants across the bed of a section: as segments in plan, and their norms along the ring.
struct SectionForces {
  Rows segments, norms, norms_upright;
  double vertical = 0.0;  // N, sum
  double scale = 0.0;     // m per N
  double sample = 0.0;    // N, of the arrow that shows the scale
  ForceUnit unit;
};

SectionForces forces_of(const Evaluation& e, const SectionEvaluation& section) {
  SectionForces out;
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  const Abscissa abscissa = sheets.empty() ? Abscissa() : abscissa_of(e.shell, sheets.back());
  double largest = 0.0, horizontal = 0.0;
  for (const BedResultant& r : section.resultants) {
    largest = std::max(largest, r.wrench.force.norm());
    horizontal = std::max(horizontal, r.wrench.force.head<2>().norm());
    out.vertical += r.wrench.force.z();
  }
  out.scale = segment_scale(e.assembly, horizontal);
  out.sample = horizontal > 0.0 ? round_down(horizontal) : 0.0;
  out.unit = force_unit(largest);
  for (const BedResultant& r : section.resultants) {
    const Vec3 &x = r.point, &f = r.wrench.force;
    out.segments.push_back({x.x(), x.y(), out.scale * f.x(), out.scale * f.y()});
    (r.kind == BlockKind::herringbone ? out.norms_upright : out.norms)
        .push_back({is_vault(e) ? r.azimuth * kDegrees : abscissa.of(x), out.unit.per_newton * f.norm()});
  }
  for (Rows* rows : {&out.norms, &out.norms_upright}) std::sort(rows->begin(), rows->end());
  return out;
}

std::string caption_of(const Evaluation& e, const SectionEvaluation& section, const SectionForces& forces) {
  std::string caption = fmt::format("Blocks cut by the plane z = {:g} m.", section.height);
  if (forces.segments.empty()) return caption;
  const ForceUnit sum = force_unit(std::abs(forces.vertical));
  return caption +
         fmt::format(
             " Arrows: horizontal part of the resultants across the bed of the nearest {}, on the part "
             "above. Bars: norm of the resultant of each block{}. Their vertical parts add up to {:.5g} {}.",
             beds_text(e.shell, section, is_vault(e) ? "ring" : "course"),
             forces.norms_upright.empty() ? "" : ", orange for upright blocks",
             sum.per_newton * forces.vertical, sum.name);
}

std::string scale_arrow(const SectionForces& forces) {
  if (forces.sample <= 0.0) return "";
  const ForceUnit unit = force_unit(forces.sample);
  return fmt::format(
      "set arrow 1 from graph 0.02,graph 0.02 rto {},0 head size screen 0.009,22,60 filled lw 1.8 lc rgb "
      "'{}'\n"
      "set label 1 '{:g} {}' at graph 0.02,graph 0.02 offset 0,0.8 tc rgb '{}'\n",
      forces.scale * forces.sample, kOrange, unit.per_newton * forces.sample, unit.name, kOrange);
}

}  // namespace

Figure section_figure(const Evaluation& e, const SectionEvaluation& section) {
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  const bool vault = is_vault(e);
  const bool wall = !sheets.empty() && sheets.back().thrust_lines == Sheet::ThrustLines::none;
  const SectionForces forces = forces_of(e, section);
  Figure f;
  f.name = fmt::format("section_{}m", section.height);
  f.title = fmt::format("Section at z = {:g} m", section.height);
  f.caption = caption_of(e, section, forces);
  f.width = 1100;
  f.height = vault ? 560 : 760;
  std::vector<std::string> plots{
      fmt::format("set size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\nunset key\n"
                  "plot $outlines w l lc rgb '#999999' lw 0.8{}\n",
                  forces.segments.empty() ? "" : ", " + arrows("segments", kOrange))};
  f.commands = plot_style() + data_block("outlines", outlines_of(section)) +
               data_block("segments", forces.segments) + data_block("norms", forces.norms) +
               data_block("upright", forces.norms_upright) + scale_arrow(forces);
  std::string bars;
  for (const auto& [name, rows, colour] :
       {std::tuple{"norms", &forces.norms, kBlue}, {"upright", &forces.norms_upright, kOrange}})
    if (!rows->empty())
      bars += fmt::format("{} ${} w impulses lc rgb '{}' lw 3", bars.empty() ? "plot" : ",", name, colour);
  if (!bars.empty())
    plots.push_back(fmt::format(
        "unset arrow 1\nunset label 1\nset size noratio\nset xlabel '{0}'\nset ylabel 'resultant of a block "
        "({1})'\nset yrange [0:*]\n{2}{3}\n",
        vault  ? "azimuth (deg)"
        : wall ? "along the wall (m)"
               : "x (m)",
        forces.unit.name, vault ? "set xrange [-180:180]\nset xtics 45\n" : "", bars));
  f.commands += panels(panel_grid(vault ? 1 : 2, vault ? 2 : 1, {0.08, 0.97, 0.11, 0.95}, 0.11, 0.11), plots);
  return f;
}

}  // namespace cupola
