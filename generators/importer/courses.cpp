#include "generators/importer/courses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "generators/importer/course_labels.hpp"

namespace cupola {
namespace {

constexpr double kOnAxis = 1e-9;      // of the size of the model: an axis nearer the z axis is the z axis
constexpr double kRounding = 1e-12;   // rad
constexpr double kJointInWall = 0.1;  // of the size of a stone: a hole not wider is a joint
constexpr double kInLine = 1e-2;      // of the size of the model: the radius of its circle is beyond 12 sizes

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

/// The width of the hole about the axis over the size of the stone beside it; negative in masonry.
double hole_about(const Vec3& origin, const std::vector<int>& stones, const Assembly& assembly) {
  double nearest = std::numeric_limits<double>::infinity(), size = 0.0;  // m
  for (const Part& part : assembly.parts) {
    if (std::ranges::find(stones, part.block) == stones.end()) continue;
    const Block& block = assembly.blocks[part.block];
    const Vec3 axis(origin.x(), origin.y(), block.centroid.z());
    double outside = -std::numeric_limits<double>::infinity();
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const Plane plane = polygon_plane(face_points(assembly, f));
      outside = std::max(outside, plane.normal.dot(axis) - plane.offset);
    }
    if (outside < nearest) size = std::cbrt(block.volume);
    nearest = std::min(nearest, outside);
  }
  return 2.0 * nearest / size;
}

/// True if each course is a ring about the axis, or a single stone above all others. Two leaves of two stones
/// are a ring, too, but about a joint.
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
  return std::ranges::any_of(courses.stones, [&](const std::vector<int>& stones) {
    return hole_about(origin, stones, assembly) > kJointInWall;
  });
}

/// True if stones of a course lead from joint to joint about the axis, as rings in layers and those beside
/// openings above or below do.
bool lead_about(const Vec3& origin, const std::vector<int>& stones, const Courses& courses,
                const CourseFinder& finder, const Assembly& assembly) {
  const auto turn = [&](int from, int to) {  // rad
    const Vec3 p = assembly.blocks[from].centroid - origin, q = assembly.blocks[to].centroid - origin;
    return std::atan2(p.x() * q.y() - p.y() * q.x(), p.x() * q.x() + p.y() * q.y());
  };
  std::map<int, double> turned;  // from the first stone that joints reach
  for (const int start : stones) {
    if (!turned.try_emplace(start, 0.0).second) continue;
    std::vector<int> open{start};
    for (size_t i = 0; i < open.size(); ++i)
      for (const int next : finder.beside(courses.course, open[i])) {
        const double there = turned[open[i]] + turn(open[i], next);
        const auto [known, is_new] = turned.try_emplace(next, there);
        if (is_new) open.push_back(next);
        if (std::abs(known->second - there) > std::numbers::pi) return true;
      }
  }
  return false;
}

/// True if the courses are rings, in layers or with openings, about the axis. The hole is wider than a stone,
/// unlike the cavity between two leaves of a wall.
bool surround(const Vec3& origin, const Courses& courses, const CourseFinder& finder,
              const Assembly& assembly) {
  return std::ranges::any_of(courses.stones, [&](const std::vector<int>& stones) {
    return lead_about(origin, stones, courses, finder, assembly) &&
           hole_about(origin, stones, assembly) > 1.0;
  });
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

/// True if stones lead from each group of supports to all others.
bool are_connected(const std::vector<std::vector<int>>& groups, const JointGraph& graph,
                   const Assembly& assembly) {
  std::set<int> known;
  for (const int support : groups.front())
    for (const int first : graph.neighbours[support]) {
      if (assembly.blocks[first].fixed || !known.insert(first).second) continue;
      const std::vector<int> distance = graph.distances(assembly, {first});
      const auto is_reached = [&](int b) { return distance[b] != JointGraph::kFar; };
      for (const int b : graph.neighbours[support])
        if (is_reached(b)) known.insert(b);
      if (std::ranges::all_of(groups, [&](const std::vector<int>& group) {
            return std::ranges::any_of(
                group, [&](int s) { return std::ranges::any_of(graph.neighbours[s], is_reached); });
          }))
        return true;
    }
  return false;
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
    const bool on_springers =
        surround_an_axis(footings, size_of(*assembly)) && are_connected(groups, graph, *assembly);
    sheet.closed =
        courses.refusal.empty() && (are_rings(courses, *assembly, sheet.origin) ||
                                    (!on_springers && surround(sheet.origin, courses, finder, *assembly)));
    sheet.thrust_lines = sheet.closed ? by_azimuth : axis || on_springers ? radial : none;
    report.kind = sheet.closed                   ? "rings about a vertical axis"
                  : sheet.thrust_lines == radial ? "from several springers or about the given axis"
                                                 : "a wall";
  }
  if (axis && sheet.thrust_lines == one)
    throw InputError("geometry.import.axis: must be left out: an arch pushes along its span");
  report.refusal = courses.refusal;
  const bool found = courses.refusal.empty();
  sheet.num_rings = found ? static_cast<int>(courses.stones.size()) : 0;
  report.courses = found ? sheet.num_rings : 0;
  if (found) label_courses(courses, finder, graph, sheet, assembly);
  if (found || sheet.thrust_lines == radial) assembly->sheets = {sheet};
  return report;
}

}  // namespace cupola
