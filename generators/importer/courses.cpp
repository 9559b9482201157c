#include "generators/importer/courses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include "generators/importer/course_labels.hpp"

namespace cupola {
namespace {

constexpr double kOnAxis = 1e-9;     // of the size of the model: an axis nearer the z axis is the z axis
constexpr double kRounding = 1e-12;  // rad
constexpr double kInLine = 1e-2;     // of the size of the model: the radius of its circle is beyond 12 sizes

/// Area of the faces of free blocks on these supports (m2), and its centroid.
struct Footing {
  double area = 0.0;
  Vec3 centroid = Vec3::Zero();
};

Footing footing_of(const Assembly& assembly, const JointGraph& graph, const std::vector<int>& supports) {
  Footing footing;
  std::set<int> faces;
  for (size_t b = 0; b < assembly.blocks.size(); ++b)
    for (const JointGraph::Face& face : graph.faces[b])
      if (!assembly.blocks[b].fixed && std::ranges::find(supports, face.other) != supports.end())
        faces.insert(face.face);
  for (const int f : faces) {
    const std::vector<Vec3> polygon = face_points(assembly, f);
    footing.area += polygon_area(polygon);
    footing.centroid += polygon_area(polygon) * polygon_centroid(polygon);
  }
  if (footing.area > 0.0) footing.centroid /= footing.area;
  return footing;
}

double size_of(const Assembly& assembly) {
  Eigen::AlignedBox3d box;
  for (const Vec3& v : assembly.vertices) box.extend(v);
  return box.sizes().maxCoeff();
}

/// True if each course is a ring about the axis, or a single stone above all others.
bool are_rings(const Courses& courses, const Assembly& assembly, const Vec3& origin) {
  if (!courses.closed.front()) return false;
  for (size_t k = 0; k < courses.stones.size(); ++k) {
    const std::vector<int>& stones = courses.stones[k];
    if (!courses.closed[k] && (stones.size() > 1 || k + 1 < courses.stones.size())) return false;
    double turn = 0.0;
    for (size_t i = 0; i < stones.size(); ++i) {
      const Vec3 p = assembly.blocks[stones[i]].centroid - origin,
                 q = assembly.blocks[stones[(i + 1) % stones.size()]].centroid - origin;
      turn += std::atan2(p.x() * q.y() - p.y() * q.x(), p.x() * q.x() + p.y() * q.y());
    }
    if (stones.size() > 1 && std::abs(turn) < std::numbers::pi) return false;
  }
  return true;
}

/// An axis that is the z axis but for rounding becomes that.
void snap_to_z_axis(const Assembly& assembly, Sheet* sheet) {
  sheet->origin.z() = 0.0;
  if (sheet->origin.norm() < kOnAxis * size_of(assembly)) sheet->origin.setZero();
}

/// True if footings lie about an axis: seen from above, one is beside the line of the first and the farthest.
bool surround_an_axis(const std::vector<Footing>& footings, double size) {
  std::vector<Eigen::Vector2d> from_first;
  for (const Footing& footing : footings)
    from_first.emplace_back((footing.centroid - footings.front().centroid).head<2>());
  const Eigen::Vector2d line = std::ranges::max(from_first, {}, &Eigen::Vector2d::norm).stableNormalized();
  return std::ranges::any_of(from_first, [&](const Eigen::Vector2d& d) {
    return std::abs(line.x() * d.y() - line.y() * d.x()) > kInLine * size;
  });
}

/// True if the stones on these supports are those of the last course.
bool ends_on(const std::vector<int>& supports, const Courses& courses, const JointGraph& graph) {
  std::set<int> stones;
  for (const int support : supports)
    for (const int b : graph.neighbours[support])
      if (courses.course[b] >= 0) stones.insert(b);
  const std::vector<int>& last = courses.stones.back();
  return stones == std::set<int>(last.begin(), last.end());
}

}  // namespace

CourseReport set_courses(std::span<const FacePair> joints, std::span<const int> numbers,
                         const std::optional<Vec3>& axis, Assembly* assembly) {
  using enum Sheet::ThrustLines;
  const JointGraph graph(*assembly, joints);
  std::vector<std::vector<int>> groups = graph.groups_of_supports(*assembly);
  CourseReport report;
  report.of_file = !numbers.empty();
  if (groups.empty()) {
    report.refusal = "no support has a joint";
    return report;
  }
  std::vector<int> supports;
  std::vector<Footing> footings;
  for (const std::vector<int>& group : groups) {
    supports.insert(supports.end(), group.begin(), group.end());
    footings.push_back(footing_of(*assembly, graph, group));
  }
  const Vec3 d = groups.size() == 2 ? Vec3(footings[1].centroid - footings[0].centroid) : Vec3::Zero();
  if (d.x() > 0.0 || (d.x() == 0.0 && d.y() > 0.0)) std::swap(groups[0], groups[1]);  // the first lies at +x

  Sheet sheet;
  sheet.name = "blocks";
  const Vec3 middle = groups.size() == 2 ? Vec3(0.5 * (footings[0].centroid + footings[1].centroid))
                                         : footing_of(*assembly, graph, supports).centroid;

  CourseFinder finder(*assembly, graph, numbers);
  Courses courses;
  const bool spans = d.head<2>().norm() > kOnAxis * size_of(*assembly);
  if (spans) {
    courses = finder.find(groups.front());
    if (courses.refusal.empty() && !ends_on(groups.back(), courses, graph))
      courses.refusal = "the stones on the second support are not the last course";
    sheet.thrust_lines = one;
    sheet.turn = d.x() == 0.0 ? 0.5 * std::numbers::pi : std::atan(d.y() / d.x());
    if (std::abs(sheet.turn) < kRounding) sheet.turn = 0.0;
    const Vec3 own_x = Eigen::AngleAxisd(sheet.turn, Vec3::UnitZ()) * Vec3::UnitX();
    sheet.origin = middle.dot(own_x) * own_x;
    snap_to_z_axis(*assembly, &sheet);
    report.kind = "an arch";
  }
  if (!spans || !courses.refusal.empty()) {
    courses = finder.find(supports);
    sheet.turn = 0.0;
    sheet.origin = axis.value_or(middle);
    snap_to_z_axis(*assembly, &sheet);
    sheet.closed = courses.refusal.empty() && are_rings(courses, *assembly, sheet.origin);
    sheet.thrust_lines = sheet.closed                                             ? by_azimuth
                         : axis || surround_an_axis(footings, size_of(*assembly)) ? radial
                                                                                  : none;
    report.kind = sheet.closed                   ? "rings about a vertical axis"
                  : sheet.thrust_lines == radial ? "from several springers or about the given axis"
                                                 : "a wall";
  }
  report.refusal = courses.refusal;
  const bool found = courses.refusal.empty();
  sheet.num_rings = found ? static_cast<int>(courses.stones.size()) : 0;
  report.courses = found ? sheet.num_rings : 0;
  if (found) label_courses(courses, finder, graph, sheet, assembly);
  if (found || sheet.thrust_lines == radial) assembly->sheets = {sheet};
  return report;
}

}  // namespace cupola
