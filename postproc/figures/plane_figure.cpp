#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Axes of the page in the plane: `up` as close to the vertical as possible, `right` perpendicular to it as
/// seen against the normal.
struct Page {
  Vec3 right, up;
  Page(const Vec3& normal, const Vec3& vertical) {
    const Vec3 level = vertical - vertical.dot(normal) * normal;
    constexpr double kLevel = 1e-6;  // a horizontal plane is drawn with y up
    up = level.norm() > kLevel ? level.normalized() : Vec3(Vec3::UnitY() - normal.y() * normal).normalized();
    right = up.cross(normal);
  }
  std::vector<double> row(const Vec3& x) const { return {right.dot(x), up.dot(x)}; }
};

std::string caption_of(const PlaneCut& cut, double largest, const ForceUnit& unit) {
  const Vec3& f = cut.across.force;
  const double through = f.dot(cut.normal), along = (f - through * cut.normal).norm();
  const ForceUnit sum = force_unit(f.norm());
  std::string text = fmt::format(
      "The plane through ({:g}, {:g}, {:g}) m with normal ({:.3g}, {:.3g}, {:.3g}). Circles: normal force of "
      "each joint across it, compression blue and tension orange; their areas are to scale, the largest is "
      "{:.3g} {}. On the blocks beyond, {} {} {:.4g} {} along the normal and {:.4g} {} in the plane.",
      cut.point.x(), cut.point.y(), cut.point.z(), cut.normal.x(), cut.normal.y(), cut.normal.z(),
      unit.per_newton * largest, unit.name, counted(cut.joints.size(), "joint"),
      cut.joints.size() == 1 ? "exerts" : "together exert", sum.per_newton * through, sum.name,
      sum.per_newton * along, sum.name);
  if (!cut.from_ties.isZero(0.0))
    text += fmt::format(" The ties across it exert {} along the normal.",
                        force_text(cut.from_ties.dot(cut.normal)));
  const ForceUnit load = force_unit(cut.load_beyond.norm());
  return text +
         fmt::format(
             " Together with the supports beyond, they balance the load beyond, of which {:.5g} {} act "
             "downwards, to a relative difference of {:.1e}.",
             load.per_newton * -cut.load_beyond.z(), load.name, cut.relative_difference);
}

}  // namespace

Figure plane_figure(const Evaluation& e, const PlaneCut& cut) {
  const Page page(cut.normal, e.up);
  Rows outlines, presses, pulls;
  for (const CutPolygon& polygon : cut.polygons) {
    for (const Vec3& x : polygon.outline) outlines.push_back(page.row(x));
    outlines.push_back(page.row(polygon.outline.front()));
    outlines.push_back({});
  }
  double largest = 0.0;
  for (const int j : cut.joints)
    largest =
        std::max(largest, std::abs(force_beyond(cut, e.assembly, e.last.joints.wrenches[j]).dot(cut.normal)));
  for (const int j : cut.joints) {
    const JointWrench& joint = e.last.joints.wrenches[j];
    const double through = force_beyond(cut, e.assembly, joint).dot(cut.normal);
    if (through == 0.0) continue;
    constexpr double kLargestPoint = 3.5;  // gnuplot's point size
    std::vector<double> row = page.row(joint.centre_of_pressure);
    row.push_back(kLargestPoint * std::sqrt(std::abs(through) / largest));
    (through > 0.0 ? presses : pulls).push_back(std::move(row));
  }
  Figure f;
  f.name = "cut_" + cut.name;
  f.title = "Cut " + cut.name;
  f.caption = caption_of(cut, largest, force_unit(largest));
  f.width = 1000;
  f.height = 700;
  f.commands = plot_style() + data_block("outlines", outlines) + data_block("presses", presses) +
               data_block("pulls", pulls) +
               "set size ratio -1\nset xlabel 'across (m)'\nset ylabel 'up (m)'\nunset key\n"
               "plot $outlines w l lc rgb '#999999' lw 0.8" +
               (presses.empty() ? "" : fmt::format(", $presses w p pt 7 ps variable lc rgb '{}'", kBlue)) +
               (pulls.empty() ? "" : fmt::format(", $pulls w p pt 7 ps variable lc rgb '{}'", kOrange)) +
               "\n";
  return f;
}

}  // namespace cupola
