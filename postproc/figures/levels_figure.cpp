#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/tables/mesh_output.hpp"

namespace cupola {
namespace {

/// A parallel projection: the unit vectors that point right and up on the page, and towards the reader.
struct Projection {
  Vec3 right, up, towards;
  std::vector<double> row(const Vec3& x) const { return {right.dot(x), up.dot(x)}; }
};

/// True of a vault about the z axis, of imported blocks and of arches that span several ways.
bool is_seen_obliquely(const std::vector<Sheet>& sheets) {
  using enum Sheet::ThrustLines;
  if (sheets.empty() || sheets.back().thrust_lines == by_azimuth) return true;
  constexpr double kOneWay = 0.99;  // cosine, of 8 degrees
  return sheets.back().thrust_lines == one && std::ranges::any_of(sheets, [&](const Sheet& arch) {
           return arch.thrust_lines == one &&
                  std::abs(arch.towards(0.0).dot(sheets.back().towards(0.0))) < kOneWay;
         });
}

/// Obliquely from above, or arches and walls in elevation.
Projection projection_of(const Evaluation& e) {
  if (!is_seen_obliquely(e.assembly.sheets)) {
    const Vec3 right = abscissa_of(e.shell, e.assembly.sheets.back()).direction;
    return {right, Vec3::UnitZ(), right.cross(Vec3::UnitZ())};
  }
  const double a = -60.0 / kDegrees, slant = 30.0 / kDegrees;  // seen from azimuth a and from above
  const Vec3 right(-std::sin(a), std::cos(a), 0.0);
  const Vec3 up(-std::sin(slant) * std::cos(a), -std::sin(slant) * std::sin(a), std::cos(slant));
  return {right, up, right.cross(up)};
}

using Rows = std::vector<std::vector<double>>;

/// The outline of a face of a block, from its corners as built.
void add_outline(const Evaluation& e, int block, const Projection& page, const std::vector<Vec3>& corners,
                 Rows* rows) {
  for (const Vec3& x : corners) rows->push_back(page.row(e.last.poses.placed(block, x)));
  rows->push_back(page.row(e.last.poses.placed(block, corners.front())));
  rows->push_back({});
}

/// Outlines of the bed facets at the sections of a vault, or of the block faces of a wall.
Rows outlines_of(const Evaluation& e, const Projection& page) {
  Rows rows;
  if (is_vault(e)) {
    for (const SectionEvaluation& section : e.sections)
      for (const int bed : section.beds)
        for (const BedFacet& f : e.shell.beds[bed])
          add_outline(e, f.block, page, {f.intrados_a, f.intrados_b, f.extrados_b, f.extrados_a}, &rows);
    return rows;
  }
  for (const Part& part : e.assembly.parts) {
    if (e.assembly.blocks[part.block].fixed) continue;
    for (int face = part.face_start; face < part.face_start + part.num_faces; ++face)
      if (e.assembly.face_kinds[face] == FaceKind::intrados)
        add_outline(e, part.block, page, face_points(e.assembly, face), &rows);
  }
  return rows;
}

}  // namespace

Figure levels_figure(const Evaluation& e) {
  const Projection page = projection_of(e);
  double largest = 0.0;
  for (const SectionEvaluation& section : e.sections)
    for (const BedResultant& r : section.resultants) largest = std::max(largest, r.wrench.force.norm());
  const double scale = segment_scale(e.assembly, largest);
  const ForceUnit unit = force_unit(largest);

  Rows flat, upright;
  double lowest = 1e300, left = 1e300;
  for (const SectionEvaluation& section : e.sections)
    for (const BedResultant& r : section.resultants) {
      const std::vector<double> from = page.row(r.point), along = page.row(scale * r.wrench.force);
      Rows& rows = r.kind == BlockKind::herringbone ? upright : flat;
      rows.push_back({from[0], from[1], along[0], along[1]});
      lowest = std::min(lowest, from[1]);
      left = std::min(left, from[0]);
    }
  const double sample = round_down(largest);  // N, length of the scale bar
  const Rows measure = {{left, lowest - 0.8 * scale * largest, 0.0, scale * sample}};

  Figure f;
  f.name = "levels";
  f.title = "Resultants across the beds at each level";
  f.caption = fmt::format(
      "Resultant of each block across the beds nearest to the sections, acting on the part above, drawn "
      "where it acts and to one scale (bottom left){}.",
      upright.empty()
          ? ""
          : ". Blue: blocks laid flat. Orange: upright blocks of a herringbone, several of which share the "
            "width of one flat block");
  f.width = 1000;
  f.height = 760;
  f.commands = plot_style() + data_block("outlines", outlines_of(e, page)) + data_block("flat", flat) +
               data_block("upright", upright) + data_block("measure", measure) +
               fmt::format(
                   "set size ratio -1\nunset border\nunset tics\nunset grid\nunset key\n"
                   "set label '{:g} {}' at {},{} offset 0.8,0.9\n"
                   "plot $outlines w l lc rgb '#bbbbbb' lw 0.8, {}{}{}\n",
                   unit.per_newton * sample, unit.name, measure[0][0], measure[0][1],
                   arrows("measure", "black"), flat.empty() ? "" : ", " + arrows("flat", kBlue),
                   upright.empty() ? "" : ", " + arrows("upright", kOrange));
  return f;
}

}  // namespace cupola
