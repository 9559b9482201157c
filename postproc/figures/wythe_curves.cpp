#include "postproc/figures/wythe_curves.hpp"

#include <cmath>

#include <fmt/format.h>

#include "assembly/export/placed_assembly.hpp"
#include "postproc/figures/gnuplot.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

struct WytheColours {
  const char *line, *section;
};

/// Of a wythe, by its place in its drum or shell; other than those of the curves of the whole thickness.
WytheColours colours_of(const Shell& shell, int wythe) {
  if (shell.innermost[wythe] == wythe) return {"#7B3F00", "#f1dcc8"};
  if (wythe + 1 == shell.num_wythes || shell.innermost[wythe + 1] == wythe + 1) return {"#B8860B", "#fbeac2"};
  return {"#555555", "#f7f7f7"};
}
constexpr const char* kBonderSection = "#dfe4e8";

/// The plane of a meridian, or the middle of the width of an arch. It is shifted by a hair, since joints may
/// lie in it.
Plane plane_of(const ThrustLine& line) {
  constexpr double kHair = 1e-6;  // m
  const Vec3 along = line.axis.towards(line.azimuth_deg / kDegrees), normal(-along.y(), along.x(), 0.0);
  const Vec3& on = line.arch ? line.points.front().intrados : line.axis.origin;
  return {normal, normal.dot(on) + kHair};
}

/// The outlines of the cut blocks of a member, and whether it is a wythe.
struct CutMember {
  Rows outlines;
  bool is_wythe = true;
};

std::vector<CutMember> cut_members(const Evaluation& e, const ThrustLine& line) {
  std::vector<CutMember> cut(e.assembly.members.size());
  const Assembly placed = placed_assembly({e.assembly, e.last.poses.of_block, {}});
  for (const CutPolygon& polygon : cut_by_plane(placed, plane_of(line))) {
    const Block& block = placed.blocks[polygon.block];
    if (block.fixed || (!line.arch && profile_abscissa(line, block.centroid) <= 0.0)) continue;
    Rows& rows = cut[block.member].outlines;
    cut[block.member].is_wythe = e.shell.wythes[polygon.block] == WytheRange{block.member, block.member + 1};
    for (const Vec3& p : polygon.outline) rows.push_back({profile_abscissa(line, p), p.z()});
    rows.push_back({profile_abscissa(line, polygon.outline.front()), polygon.outline.front().z()});
    rows.push_back({});
  }
  return cut;
}

void add_section(const Evaluation& e, const ThrustLine& line, WytheCurves* out) {
  const std::vector<CutMember> cut = cut_members(e, line);
  for (int m = 0; m < static_cast<int>(cut.size()); ++m) {
    if (cut[m].outlines.empty()) continue;
    const std::string name = fmt::format("cut_{}", m);
    out->data += data_block(name, cut[m].outlines);
    out->section += fmt::format(
        "${0} w filledcurves closed fc rgb '{1}' notitle, ${0} w l lc rgb '#999999' lw 0.5 notitle, ", name,
        cut[m].is_wythe ? colours_of(e.shell, m).section : kBonderSection);
  }
}

}  // namespace

double profile_abscissa(const ThrustLine& line, const Vec3& point) {
  const double angle = line.azimuth_deg / kDegrees;
  const Vec3 own = line.axis.own(point);
  return std::cos(angle) * own.x() + std::sin(angle) * own.y();
}

WytheCurves wythe_curves(const Evaluation& e, const MeridianEvaluation& m, const ForceUnit& unit) {
  WytheCurves out;
  if (m.wythes.empty()) return out;
  const bool arch = m.thrust.arch;
  add_section(e, m.thrust, &out);
  for (const ThrustLine& line : m.wythes) {
    Rows profile, graphs;
    int last = -1;
    for (const ThrustPoint& p : line.points) {
      if (p.bed != last + 1)
        for (Rows* rows : {&profile, &graphs}) rows->emplace_back();
      last = p.bed;
      profile.push_back(p.is_placed() ? std::vector{profile_abscissa(line, p.point), p.point.z()}
                                      : std::vector<double>{});
      graphs.push_back({arch ? profile_abscissa(line, 0.5 * (p.intrados + p.extrados)) : p.height(),
                        unit.per_newton * p.r, p.couple_length, p.face_distance});
    }
    const std::string name = fmt::format("wythe_{}", *line.wythe), curves = name + "_graphs";
    const char* colour = colours_of(e.shell, *line.wythe).line;
    out.data += data_block(name, profile) + data_block(curves, graphs);
    out.lines += fmt::format(", ${} w lp lc rgb '{}' lw 1.8 pt 7 ps 0.35 title '{}'", name, colour,
                             gnuplot_text(e.assembly.members[*line.wythe]));
    const auto curve = [&](int column) {
      return fmt::format(", ${} using {} w lp lc rgb '{}' pt 7 ps 0.3 notitle", curves,
                         arch ? fmt::format("1:{}", column) : fmt::format("{}:1", column), colour);
    };
    out.resultant += curve(2);
    out.couple += curve(3);
    out.distance += curve(4);
  }
  return out;
}

}  // namespace cupola
