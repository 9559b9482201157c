#include "postproc/figures/shell_maps.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/with_capital.hpp"
#include "postproc/figures/plot_style.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr const char* kSequential =
    "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n";

std::string map_axes(const ShellMap& map) {
  return (map.vault ? "set xrange [-180:180]\nset xtics 45\nset xlabel 'azimuth (deg)'\n"
                    : fmt::format("set xlabel '{} (m)'\n", map.arch ? "y" : "along the wall")) +
         fmt::format(
             "set yrange [{}:{}]\nset ytics {}\nset ylabel '{}'\nunset grid\nset style fill solid 1 "
             "noborder\n"
             "set key at graph 1,1 right bottom horizontal\n",
             map.first_ring, map.num_rings, std::max(1, (map.num_rings - map.first_ring + 7) / 8),
             map.vault ? "ring" : "course");
}

/// One panel: the boxes whose value is a number in colour, negative ones with a dot that remains without
/// colours, all others in grey.
std::string panel(const ShellMap& map, double (*value)(const ShellBox&), const std::string& name,
                  const std::string& grey, const std::string& settings) {
  Rows known, others, pulls;
  for (const auto& [box, rings] : tall_boxes(map)) {
    const double v = value(box);
    // A block that crosses +-180 degrees is drawn at both ends.
    for (const double turn : {0.0, -360.0, 360.0}) {
      if (turn != 0.0 && (!map.vault || box.to + turn <= -180.0 || box.from + turn >= 180.0)) continue;
      const double r = box.ring;
      std::vector<double> row{
          0.5 * (box.from + box.to) + turn, r + 0.5 * rings, box.from + turn, box.to + turn, r, r + rings};
      if (std::isfinite(v)) row.push_back(v);
      if (v < 0.0) pulls.push_back({row[0], row[1]});
      (std::isfinite(v) ? known : others).push_back(std::move(row));
    }
  }
  std::string plots;
  if (!known.empty())
    plots += fmt::format("${} using 1:2:3:4:5:6:7 with boxxyerror fc palette notitle", name);
  if (!pulls.empty())
    plots +=
        fmt::format(", ${}_pulls using 1:2 with points pt 7 ps 0.3 lc rgb '#222222' title 'tension'", name);
  if (!others.empty())
    plots += fmt::format("{}${}_grey using 1:2:3:4:5:6 with boxxyerror fc rgb '{}' title '{}'",
                         plots.empty() ? "" : ", ", name, kGrey, grey);
  return data_block(name, known) + data_block(name + "_pulls", pulls) + data_block(name + "_grey", others) +
         settings + "plot " + plots + "\n";
}

/// kN/m; NaN for negligible forces, which block_fields() sets to zero.
double shown(double newtons_per_metre) {
  return newtons_per_metre == 0.0 ? BlockFields::kNone : 1e-3 * newtons_per_metre;
}

/// One panel above the other; without commands if there is none.
void draw_panels(const ShellMap& map, const std::vector<std::string>& plots, Figure* f) {
  const int count = static_cast<int>(plots.size());
  f->width = 1100;
  f->height = 20 + 400 * count;
  f->vector = map.boxes.size() <= kMostVectorBoxes;
  if (count == 0) return;
  f->commands =
      plot_style() + map_axes(map) + kSequential +
      panels(panel_grid(plots.size(), 1, {0.07, 0.88, 65.0 / f->height, 1.0 - 33.0 / f->height}, 0.0, 0.13),
             plots);
}

/// The end of a colour scale, which must be positive.
double end_of(double most) {
  return most > 0.0 ? most : 1.0;
}

}  // namespace

std::string mapped_text(const ShellMap& map) {
  if (!map.wythe.empty()) return fmt::format("wythe {}", map.wythe);
  return map.vault ? "shell" : map.arch ? "arch" : "wall";
}

void MapScales::include(const ShellMap& map) {
  for (const ShellBox& box : map.boxes) {
    compression = std::max(compression, 1e-3 * box.meridional_force);
    tension = std::max(tension, -1e-3 * box.meridional_force);
    hoop = std::max(hoop, 1e-3 * std::abs(box.hoop_force));
    kern = std::fmax(kern, box.kern);  // skips NaN
    friction = std::fmax(friction, box.friction_use);
  }
}

Figure force_map(const ShellMap& map, const MapScales& scales) {
  Figure f;
  f.name = fmt::format("map_forces{}", map.suffix());
  const char* along = map.vault ? "meridional" : map.arch ? "axial" : "vertical";
  const char* across = map.vault ? "hoop" : map.arch ? "lateral" : "horizontal";
  f.title = map.vault || scales.hoop > 0.0 ? fmt::format("{} and {} forces over the ", along, across)
                                           : fmt::format("{} forces over the ", along);
  f.title = with_capital(f.title) + mapped_text(map);
  f.caption = fmt::format(
      "The {}{}{}. Forces per metre from the mean stress of each block, compression positive{}. Grey: the "
      "force is negligible.",
      map.vault || map.arch ? "unrolled " : "", mapped_text(map),
      map.vault  ? ""
      : map.arch ? " from the right springing (course 0) to the left"
                 : " from the front",
      scales.hoop > 0.0 ? fmt::format("; {} tension is orange and has dots", across) : "");
  std::vector<std::string> panels;
  if (scales.compression > 0.0 || scales.tension > 0.0)
    panels.push_back(panel(
        map, [](const ShellBox& b) { return shown(b.meridional_force); }, "meridional", "negligible",
        fmt::format("set cbrange [{}:{}]\nset cblabel '{} force (kN/m)'\n", -scales.tension,
                    end_of(scales.compression), along)));
  if (scales.hoop > 0.0)
    panels.push_back(panel(
        map, [](const ShellBox& b) { return shown(b.hoop_force); }, "hoop", "negligible",
        fmt::format(
            "set palette defined (-1 '{0}', 0 '#f7f7f7', 1 '{1}')\nset cbrange [{2}:{3}]\nset cblabel "
            "'{4} force (kN/m), compression positive'\n",
            kOrange, kBlue, -end_of(scales.hoop), end_of(scales.hoop), across)));
  draw_panels(map, panels, &f);
  return f;
}

Figure utilisation_map(const ShellMap& map, const MapScales& scales) {
  Figure f;
  f.name = fmt::format("map_utilisation{}", map.suffix());
  f.title = fmt::format("Utilisation of the joints over the {}", mapped_text(map));
  f.caption =
      "Largest friction use of the joints of each block (100 %: the joint slides), and largest "
      "kern use of its bed joints (above 1: part of the joint is unloaded or pulls). Grey: no such joint "
      "carries more than a negligible force.";
  std::vector<std::string> panels;
  if (scales.friction > 0.0)
    panels.push_back(panel(
        map, [](const ShellBox& b) { return 100.0 * b.friction_use; }, "friction", "no loaded joint",
        "set cbrange [0:100]\nset cblabel 'friction use (%)'\n"));
  if (scales.kern > 0.0)
    panels.push_back(panel(
        map, [](const ShellBox& b) { return b.kern; }, "kern", "no loaded bed joint",
        fmt::format("set cbrange [0:{}]\nset cblabel 'kern use'\n", end_of(scales.kern))));
  draw_panels(map, panels, &f);
  return f;
}

}  // namespace cupola
