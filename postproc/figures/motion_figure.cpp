#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/projection.hpp"

namespace cupola {
namespace {

/// A face of a displaced block as the reader sees it.
struct SeenFace {
  std::vector<Vec3> corners;
  double depth = 0.0;  // m, towards the reader
  double share = 0.0;  // of the largest displacement
  double light = 1.0;  // 1 if it faces the reader
};

Vec3 normal_of(const std::vector<Vec3>& corners) {
  Vec3 normal = Vec3::Zero();
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    normal += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  return normal.stableNormalized();
}

double largest_displacement_of(const BlockTable& blocks) {
  double largest = 0.0;
  for (const Vec3& d : blocks.displacement) largest = std::max(largest, d.norm());
  return largest;
}

/// The faces towards the reader, from the farthest to the nearest, so that each hides those behind it.
std::vector<SeenFace> seen_faces(const Evaluation& e, const Shot& shot, const Projection& page,
                                 double largest) {
  const BlockTable& blocks = shot.blocks;
  std::vector<SeenFace> faces;
  for (const Part& part : e.assembly.parts) {
    const Block& block = e.assembly.blocks[part.block];
    if (block.fixed || (shot.ring && block.ring > *shot.ring)) continue;
    const Eigen::Vector4d& q = blocks.quaternion_wxyz[part.block];
    const Mat3 R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (e.assembly.face_kinds[f] == FaceKind::internal) continue;
      SeenFace face;
      for (const Vec3& x : face_points(e.assembly, f))
        face.corners.push_back(blocks.position[part.block] + R * (x - block.centroid));
      face.light = normal_of(face.corners).dot(page.towards);
      if (face.light <= 0.0) continue;
      for (const Vec3& x : face.corners)
        face.depth += page.towards.dot(x) / static_cast<double>(face.corners.size());
      if (largest > 0.0) face.share = blocks.displacement[part.block].norm() / largest;
      faces.push_back(std::move(face));
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const SeenFace& a, const SeenFace& b) { return a.depth < b.depth; });
  return faces;
}

/// Colour of a share in the palette of kPalette, darker on faces that are seen at an angle; 0xRRGGBB.
int colour(double share, double light) {
  constexpr std::array<Vec3 (*)(), 3> kStops{[] { return Vec3(0x44, 0x01, 0x54); },
                                             [] { return Vec3(0x21, 0x91, 0x8c); },
                                             [] { return Vec3(0xfd, 0xe7, 0x25); }};
  const double at = std::clamp(2.0 * share, 0.0, 2.0);
  const size_t i = at < 1.0 ? 0 : 1;
  const double t = at - static_cast<double>(i);
  const Vec3 rgb = (0.65 + 0.35 * light) * ((1.0 - t) * kStops[i]() + t * kStops[i + 1]());
  return (static_cast<int>(rgb.x()) << 16) + (static_cast<int>(rgb.y()) << 8) + static_cast<int>(rgb.z());
}

/// Polygons in the order in which they are painted. Each face is painted dark, then a little smaller in its
/// colour: gnuplot draws the outlines of filled polygons last, over all of them.
/// Coordinates are multiples of `grid`, m, which keeps the script small.
std::vector<std::vector<double>> painted(const std::vector<SeenFace>& faces, const Projection& page,
                                         double grid) {
  constexpr double kOutline = 0.03;  // share of the distance to the centre
  constexpr int kDark = 0x222222;
  std::vector<std::vector<double>> rows;
  for (const SeenFace& face : faces) {
    Vec3 centre = Vec3::Zero();
    for (const Vec3& x : face.corners) centre += x / static_cast<double>(face.corners.size());
    for (const bool inner : {false, true}) {
      for (const Vec3& x : face.corners) {
        std::vector<double> row = page.row(inner ? Vec3(x + kOutline * (centre - x)) : x);
        for (double& coordinate : row) coordinate = grid * std::round(coordinate / grid);
        row.push_back(inner ? colour(face.share, face.light) : kDark);
        rows.push_back(std::move(row));
      }
      rows.push_back({});
    }
  }
  return rows;
}

/// Ranges of the page that hold all shots.
std::string ranges(const std::vector<std::vector<SeenFace>>& shots, const Projection& page) {
  Eigen::AlignedBox2d box;
  for (const auto& faces : shots)
    for (const SeenFace& face : faces)
      for (const Vec3& x : face.corners) box.extend(Eigen::Vector2d(page.right.dot(x), page.up.dot(x)));
  return fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", box.min().x(), box.max().x(), box.min().y(),
                     box.max().y());
}

std::string caption_of(const std::vector<Shot>& shots) {
  if (!shots.front().mechanism)
    return fmt::format(
        "The blocks where the motion has carried them, at {}, to scale; the colour is the displacement.",
        counted(shots.size(), "instant"));
  const std::string stages =
      shots.front().ring
          ? " Each panel shows a stage at which the vault does not stand, with the ring just laid."
          : "";
  return "The directions in which the blocks begin to move." + stages +
         " A mechanism has no amplitude: the displacements are drawn large enough to be seen, and the colour "
         "shows them relative to the largest.";
}

}  // namespace

Figure motion_figure(const Evaluation& e, const std::vector<Shot>& shots) {
  CUPOLA_ASSERT(!shots.empty());
  const Projection page = projection_of(e);
  double largest = 0.0;
  for (const Shot& shot : shots) largest = std::max(largest, largest_displacement_of(shot.blocks));
  std::vector<std::vector<SeenFace>> seen;
  for (const Shot& shot : shots) seen.push_back(seen_faces(e, shot, page, largest));
  const bool in_time = !shots.front().mechanism;
  const double grid = std::pow(10.0, std::floor(std::log10(1e-4 * model_size(e.assembly))));

  Figure f;
  f.name = "motion";
  f.title = in_time ? "Displaced shape" : "Mechanism";
  f.caption = caption_of(shots);
  f.width = shots.size() == 1 ? 900 : 1200;
  f.height = shots.size() == 1 ? 700 : 950;
  f.vector = false;
  f.commands =
      plot_style() +
      "set palette defined (0 '#440154', 0.5 '#21918c', 1 '#fde725')\nunset border\nunset tics\nunset grid\n"
      "unset key\nset style fill solid 1 noborder\nset size ratio -1\n" +
      fmt::format("set cbrange [0:{}]\nset cbtics\nset cblabel '{}'\n",
                  in_time && largest > 0.0 ? largest : 1.0,
                  in_time ? "displacement (m)" : "displacement / largest") +
      ranges(seen, page) + (shots.size() == 1 ? "" : "set multiplot layout 2,2\n");
  for (size_t i = 0; i < shots.size(); ++i) {
    f.commands += data_block(fmt::format("faces{}", i), painted(seen[i], page, grid));
    if (in_time) f.commands += fmt::format("set title 't = {:.4g} s'\n", shots[i].time);
    if (shots[i].ring)
      f.commands +=
          fmt::format("set title '{} {} just laid'\n", is_vault(e) ? "ring" : "course", *shots[i].ring);
    f.commands += fmt::format(
        "plot $faces{} using 1:2:3 with filledcurves closed fc rgb variable, NaN with points palette\n", i);
  }
  if (shots.size() > 1) f.commands += "unset multiplot\n";
  return f;
}

}  // namespace cupola
