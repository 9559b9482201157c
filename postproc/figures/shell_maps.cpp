#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

/// One row per block and ring of the unrolled shell, as gnuplot's boxxyerror takes it: x, y, x range, y
/// range, two values.
Rows unrolled(const Evaluation& e, double (*first)(const BlockFields&),
              double (*second)(const BlockFields&)) {
  const bool vault = is_vault(e);
  struct Box {
    double from, to;
  };
  std::map<std::pair<int, int>, Box> boxes;  // (block, ring)
  for (int ring = 0; ring < e.shell.num_rings(); ++ring) {
    for (const BedFacet& f : e.shell.beds[ring]) {
      const auto column = [&](const Vec3& p) { return vault ? azimuth(p) : p.x(); };
      const double a = column(f.intrados_a);
      const auto [entry, is_new] = boxes.try_emplace({f.block, ring}, Box{a, a});
      Box& box = entry->second;
      for (const Vec3& p : {f.intrados_a, f.intrados_b}) {
        const double c = vault ? box.from + wrapped(column(p) - box.from) : column(p);
        box = {std::min(box.from, c), std::max(box.to, c)};
      }
    }
  }
  Rows rows;
  for (const auto& [key, box] : boxes) {
    const auto [block, ring] = key;
    const BlockFields& fields = e.last.fields[block];
    const double unit = vault ? kDegrees : 1.0;
    const double r = ring;
    // A block that crosses +-180 degrees is drawn at both ends.
    for (const double turn : {0.0, vault && box.to > std::numbers::pi ? -360.0 : 0.0,
                              vault && box.from < -std::numbers::pi ? 360.0 : 0.0}) {
      if (turn == 0.0 && !rows.empty() && rows.back()[6] == first(fields) && rows.back()[1] == r + 0.5 &&
          rows.back()[2] == unit * box.from)
        continue;
      rows.push_back({unit * 0.5 * (box.from + box.to) + turn, r + 0.5, unit * box.from + turn,
                      unit * box.to + turn, r, r + 1.0, first(fields), second(fields)});
    }
  }
  return rows;
}

std::string map_axes(const Evaluation& e) {
  return (is_vault(e) ? "set xrange [-180:180]\nset xtics 45\nset xlabel 'azimuth (deg)'\n"
                      : "set xlabel 'x (m)'\n") +
         fmt::format("set yrange [0:{}]\nset ylabel 'ring'\nunset grid\nset style fill solid 1 noborder\n",
                     e.shell.num_rings());
}

constexpr const char* kBoxes = "using 1:2:3:4:5:6:{} with boxxyerror fc palette notitle\n";

constexpr size_t kMostVectorBoxes = 3000;  // with more, browsers are slow to open the SVG

}  // namespace

Figure force_map(const Evaluation& e) {
  const Rows rows = unrolled(
      e, [](const BlockFields& v) { return 1e-3 * v.meridional_force; },
      [](const BlockFields& v) { return 1e-3 * v.hoop_force; });
  double most = 1e-12;
  for (const auto& row : rows) most = std::max(most, std::abs(row[7]));
  Figure f;
  f.name = "map_forces";
  f.title = "Meridional and hoop forces over the shell";
  f.caption =
      "The unrolled shell. Forces per metre from the mean stress of each block, compression positive; hoop "
      "tension is orange.";
  f.width = 1100;
  f.height = 820;
  f.vector = rows.size() <= kMostVectorBoxes;
  f.commands = plot_style() + data_block("boxes", rows) + map_axes(e) +
               "set multiplot layout 2,1 margins 0.07,0.88,0.08,0.97 spacing 0.10\n"
               "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n"
               "set cblabel 'meridional force (kN/m)'\nplot $boxes " +
               fmt::format(kBoxes, 7) +
               fmt::format("set palette defined (-1 '{}', 0 '#f7f7f7', 1 '{}')\nset cbrange [{}:{}]\n",
                           kOrange, kBlue, -most, most) +
               "set cblabel 'hoop force (kN/m), compression positive'\nplot $boxes " +
               fmt::format(kBoxes, 8) + "unset multiplot\n";
  return f;
}

Figure utilisation_map(const Evaluation& e) {
  const Rows rows = unrolled(
      e, [](const BlockFields& v) { return v.friction_use; }, [](const BlockFields& v) { return v.kern; });
  Figure f;
  f.name = "map_utilisation";
  f.title = "Utilisation of the joints over the shell";
  f.caption =
      "Largest friction utilisation of the joints of each block (1: every point slides), and largest kern "
      "utilisation of its bed joints (above 1: part of the joint is unloaded).";
  f.width = 1100;
  f.height = 820;
  f.vector = rows.size() <= kMostVectorBoxes;
  f.commands = plot_style() + data_block("boxes", rows) + map_axes(e) +
               "set multiplot layout 2,1 margins 0.07,0.88,0.08,0.97 spacing 0.10\n"
               "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n"
               "set cbrange [0:1]\nset cblabel 'friction utilisation'\nplot $boxes " +
               fmt::format(kBoxes, 7) + "set cbrange [0:*]\nset cblabel 'kern utilisation'\nplot $boxes " +
               fmt::format(kBoxes, 8) + "unset multiplot\n";
  return f;
}

}  // namespace cupola
