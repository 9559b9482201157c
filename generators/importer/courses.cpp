#include "generators/importer/courses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

constexpr int kFar = std::numeric_limits<int>::max();
constexpr double kEndToEnd = 0.25;   // of the height of a course
constexpr double kOnAxis = 1e-9;     // of the size of the model: an axis nearer the z axis is the z axis
constexpr double kRounding = 1e-12;  // rad

/// The graph of joints: neighbours of each block, and the faces by which it meets them.
struct JointGraph {
  struct Face {
    int face = 0, other = 0;  // of the block; the block behind it
  };
  std::vector<std::set<int>> neighbours;
  std::vector<std::vector<Face>> faces;

  JointGraph(const Assembly& assembly, std::span<const FacePair> joints)
      : neighbours(assembly.blocks.size()), faces(assembly.blocks.size()) {
    for (const FacePair& joint : joints) {
      const int a = assembly.parts[joint.part_a].block, b = assembly.parts[joint.part_b].block;
      neighbours[a].insert(b);
      neighbours[b].insert(a);
      faces[a].push_back({joint.face_a, b});
      faces[b].push_back({joint.face_b, a});
    }
  }

  /// Least number of joints from any of the blocks to each block, not through fixed blocks.
  std::vector<int> distances(const Assembly& assembly, const std::vector<int>& from) const {
    std::vector<int> distance(neighbours.size(), kFar), open = from;
    for (const int b : from) distance[b] = 0;
    for (size_t i = 0; i < open.size(); ++i)
      for (const int next : neighbours[open[i]]) {
        if (assembly.blocks[next].fixed || distance[next] != kFar) continue;
        distance[next] = distance[open[i]] + 1;
        open.push_back(next);
      }
    return distance;
  }

  /// Fixed blocks that touch each other, by their least number.
  std::vector<std::vector<int>> groups_of_supports(const Assembly& assembly) const {
    std::vector<std::vector<int>> groups;
    std::vector<bool> known(neighbours.size(), false);
    for (int b = 0; b < static_cast<int>(neighbours.size()); ++b) {
      if (!assembly.blocks[b].fixed || known[b] || neighbours[b].empty()) continue;
      std::vector<int> group{b};
      known[b] = true;
      for (size_t i = 0; i < group.size(); ++i)
        for (const int next : neighbours[group[i]])
          if (assembly.blocks[next].fixed && !known[next]) {
            known[next] = true;
            group.push_back(next);
          }
      groups.push_back(std::move(group));
    }
    return groups;
  }
};

/// Blocks by course, each course in the order in which its stones lie.
struct Courses {
  std::vector<int> course;  // per block, -1 for a support
  std::vector<std::vector<int>> stones;
  std::vector<bool> closed;  // per course: one ring
  std::string refusal;
};

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double s = d.squaredNorm() > 0.0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - s * d).norm();
}

/// Least distance of a corner of one of the faces from an edge of the others, m.
double distance_of_faces(const Assembly& assembly, const std::vector<int>& from, const std::vector<int>& to) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [some, others] : {std::pair(&from, &to), std::pair(&to, &from)})
    for (const int f : *some)
      for (const Vec3& corner : face_points(assembly, f))
        for (const int g : *others) {
          const std::vector<Vec3> polygon = face_points(assembly, g);
          for (size_t i = 0; i < polygon.size(); ++i)
            least =
                std::min(least, distance_to_segment(corner, polygon[i], polygon[(i + 1) % polygon.size()]));
        }
  return least;
}

class CourseFinder {
 public:
  CourseFinder(const Assembly& assembly, const JointGraph& graph) : assembly_(assembly), graph_(graph) {}

  Courses find(const std::vector<int>& from) {
    const std::vector<int> distance = graph_.distances(assembly_, from);
    Courses found;
    found.course.assign(distance.size(), -1);
    std::vector<int> unreached;
    int last = -1;
    for (int b = 0; b < static_cast<int>(distance.size()); ++b) {
      if (assembly_.blocks[b].fixed) continue;
      if (distance[b] == kFar) {
        unreached.push_back(b);
        continue;
      }
      found.course[b] = distance[b] - 1;
      last = std::max(last, found.course[b]);
    }
    if (!unreached.empty() || last < 0) {
      found.refusal =
          unreached.empty() ? "no block is free" : "no joints lead from a support to " + labels(unreached);
      return found;
    }
    set_beds(found.course);
    found.stones.resize(static_cast<size_t>(last) + 1);
    for (int b = 0; b < static_cast<int>(distance.size()); ++b)
      if (found.course[b] >= 0) found.stones[found.course[b]].push_back(b);
    check(&found);
    if (found.refusal.empty())
      for (std::vector<int>& stones : found.stones)
        found.closed.push_back(put_in_order(found.course, &stones));
    return found;
  }

  const std::vector<int>& lower_bed(int block) const { return beds_[block]; }

 private:
  std::string labels(const std::vector<int>& blocks) const {
    return fmt::format("{} {}{}", blocks.size() == 1 ? "block" : "blocks", block_labels(assembly_, blocks),
                       blocks.size() > 8 ? fmt::format(" ({} in all)", blocks.size()) : "");
  }

  /// The faces of each block that meet a support or the course below.
  void set_beds(const std::vector<int>& course) {
    beds_.assign(course.size(), {});
    for (int b = 0; b < static_cast<int>(course.size()); ++b)
      for (const JointGraph::Face& face : graph_.faces[b])
        if (course[b] >= 0 && course[face.other] == course[b] - 1 &&
            std::ranges::find(beds_[b], face.face) == beds_[b].end())
          beds_[b].push_back(face.face);
  }

  std::vector<int> beside(const std::vector<int>& course, int block) const {
    std::vector<int> beside;
    for (const int next : graph_.neighbours[block])
      if (course[next] == course[block]) beside.push_back(next);
    return beside;
  }

  /// m: mean over the stones of volume over area of the lower bed.
  double height_of(const std::vector<int>& stones) const {
    double volume = 0.0, area = 0.0;
    for (const int b : stones) {
      volume += assembly_.blocks[b].volume;
      for (const int f : beds_[b]) area += polygon_area(face_points(assembly_, f));
    }
    return area > 0.0 ? volume / area : 0.0;
  }

  /// True if the faces by which a stone meets the course below look into different directions, as those of an
  /// upright stone between lower ones do.
  bool leans_on_sides(int block) const {
    constexpr double kSameSide = 0.7;  // cosine of the angle to their mean
    Vec3 mean = Vec3::Zero();
    for (const int f : beds_[block]) {
      const std::vector<Vec3> polygon = face_points(assembly_, f);
      mean += polygon_area(polygon) * polygon_plane(polygon).normal;
    }
    mean.stableNormalize();
    return std::ranges::any_of(beds_[block], [&](int f) {
      return polygon_plane(face_points(assembly_, f)).normal.dot(mean) < kSameSide;
    });
  }

  void check(Courses* found) const {
    std::vector<int> crowded, stepped, leaning;
    for (const std::vector<int>& stones : found->stones) {
      const double height = height_of(stones);
      for (const int b : stones) {
        const std::vector<int> next = beside(found->course, b);
        if (next.size() > 2) crowded.push_back(b);
        if (leans_on_sides(b)) leaning.push_back(b);
        if (std::ranges::any_of(next, [&](int other) {
              return distance_of_faces(assembly_, beds_[b], beds_[other]) > kEndToEnd * height;
            }))
          stepped.push_back(b);
      }
    }
    const auto add = [&](const char* what, const std::vector<int>& stones) {
      if (stones.empty()) return;
      found->refusal += (found->refusal.empty() ? "" : "; ") + std::string(what) + ": " + labels(stones);
    };
    add("stones with more than two neighbours in their course", crowded);
    add("stones whose lower bed does not meet that of their neighbour end to end", stepped);
    add("stones that meet the course below by their sides, too", leaning);
  }

  /// Orders the stones along their rings and chains; true for one ring.
  bool put_in_order(const std::vector<int>& course, std::vector<int>* stones) const {
    std::vector<int> starts, ordered;
    for (const int b : *stones)
      if (beside(course, b).size() < 2) starts.push_back(b);
    const auto west = [&](int b) {
      const Vec3& p = assembly_.blocks[b].centroid;
      return std::array{p.x(), p.y(), p.z()};
    };
    std::ranges::sort(starts, {}, west);
    const size_t num_ends = starts.size();
    starts.insert(starts.end(), stones->begin(), stones->end());  // of rings, which have no ends
    std::set<int> done;
    int pieces = 0;
    for (const int start : starts) {
      if (!done.insert(start).second) continue;
      ++pieces;
      std::vector<int> chain{start};
      for (size_t i = 0; i < chain.size(); ++i)
        for (const int next : beside(course, chain[i]))
          if (done.insert(next).second) {
            chain.push_back(next);
            break;
          }
      ordered.insert(ordered.end(), chain.begin(), chain.end());
    }
    *stones = std::move(ordered);
    return pieces == 1 && num_ends == 0 && stones->size() > 2;
  }

  const Assembly& assembly_;
  const JointGraph& graph_;
  std::vector<std::vector<int>> beds_;  // per block
};

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

/// The sheet of the blocks, and for each free block the directions along its course (t) and upwards on its
/// bed (m).
class Labels {
 public:
  Labels(const Courses& courses, const CourseFinder& finder, const JointGraph& graph, const Sheet& sheet,
         Assembly* assembly)
      : courses_(courses), finder_(finder), graph_(graph), sheet_(sheet), assembly_(*assembly) {}

  void set() {
    assembly_.num_rings = static_cast<int>(courses_.stones.size());
    for (int k = 0; k < assembly_.num_rings; ++k) {
      std::vector<int> stones = courses_.stones[k];
      if (sheet_.closed) std::ranges::sort(stones, {}, [&](int b) { return azimuth_of(b); });
      for (size_t slot = 0; slot < stones.size(); ++slot) {
        Block& block = assembly_.blocks[stones[slot]];
        block.ring = k;
        block.slot = static_cast<int>(slot);
        name_faces(stones, slot);
      }
    }
    for (Part& part : assembly_.parts) {
      part.ring = assembly_.blocks[part.block].ring;
      if (assembly_.blocks[part.block].fixed) name_faces_of_support(part);
    }
  }

 private:
  /// rad, in [0, 2 pi), about the axis.
  double azimuth_of(int block) const {
    const Vec3 r = assembly_.blocks[block].centroid - sheet_.origin;
    const double angle = std::atan2(r.y(), r.x());
    return angle < -kRounding ? angle + 2.0 * std::numbers::pi : std::abs(angle);
  }

  /// Along the course: about the axis, across an arch, or from stone to stone.
  Vec3 along(const std::vector<int>& stones, size_t slot) const {
    using enum Sheet::ThrustLines;
    const Block& block = assembly_.blocks[stones[slot]];
    if (sheet_.thrust_lines == one)  // constant: outwards turns from the first springing to the last
      return Eigen::AngleAxisd(sheet_.turn, Vec3::UnitZ()) * Vec3::UnitY();
    if (sheet_.closed) return Vec3::UnitZ().cross(*sheet_.outward(block.centroid));
    const Vec3 &before = assembly_.blocks[stones[slot > 0 ? slot - 1 : slot]].centroid,
               &after = assembly_.blocks[stones[std::min(slot + 1, stones.size() - 1)]].centroid;
    return (after - before).stableNormalized();
  }

  FaceKind kind_of_joint(int block, const std::vector<int>& others) const {
    const int k = courses_.course[block];
    const bool bed = std::ranges::any_of(others, [&](int other) { return courses_.course[other] != k; });
    return bed ? FaceKind::bed : FaceKind::head;
  }

  void name_faces(const std::vector<int>& stones, size_t slot) {
    const int b = stones[slot];
    Vec3 m = Vec3::Zero();
    for (const int f : finder_.lower_bed(b)) {
      const std::vector<Vec3> polygon = face_points(assembly_, f);
      m -= polygon_area(polygon) * polygon_plane(polygon).normal;
    }
    m.stableNormalize();
    Vec3 t = along(stones, slot);
    t = (t - t.dot(m) * m).stableNormalized();
    Vec3 n = t.cross(m);
    if (!sheet_.closed && sheet_.thrust_lines != Sheet::ThrustLines::one) {  // chains may run either way
      const std::optional<Vec3> outward = sheet_.outward(assembly_.blocks[b].centroid);
      if (n.dot(outward ? *outward : Vec3(Vec3::UnitY())) < 0.0) n = -n;
    }
    std::map<int, std::vector<int>> others;
    for (const JointGraph::Face& face : graph_.faces[b]) others[face.face].push_back(face.other);
    const bool last = courses_.course[b] + 1 == static_cast<int>(courses_.stones.size());
    for (const Part& part : assembly_.parts) {
      if (part.block != b) continue;
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
        FaceKind& kind = assembly_.face_kinds[f];
        if (kind == FaceKind::internal) continue;
        const auto joint = others.find(f);
        kind = joint != others.end()
                   ? kind_of_joint(b, joint->second)
                   : kind_of_free(polygon_plane(face_points(assembly_, f)).normal, t, m, n, last);
      }
    }
  }

  static FaceKind kind_of_free(const Vec3& normal, const Vec3& t, const Vec3& m, const Vec3& n, bool last) {
    const double through = normal.dot(n), up = normal.dot(m);
    if (std::abs(through) > std::max(std::abs(up), std::abs(normal.dot(t))))
      return through > 0.0 ? FaceKind::extrados : FaceKind::intrados;
    return last && up > std::abs(normal.dot(t)) ? FaceKind::top : FaceKind::free;
  }

  void name_faces_of_support(const Part& part) {
    for (const JointGraph::Face& face : graph_.faces[part.block])
      if (!assembly_.blocks[face.other].fixed && face.face >= part.face_start &&
          face.face < part.face_start + part.num_faces)
        assembly_.face_kinds[face.face] = FaceKind::bed;
  }

  const Courses& courses_;
  const CourseFinder& finder_;
  const JointGraph& graph_;
  const Sheet& sheet_;
  Assembly& assembly_;
};

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

CourseReport set_courses(std::span<const FacePair> joints, const std::optional<Vec3>& axis,
                         Assembly* assembly) {
  using enum Sheet::ThrustLines;
  const JointGraph graph(*assembly, joints);
  std::vector<std::vector<int>> groups = graph.groups_of_supports(*assembly);
  CourseReport report;
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

  CourseFinder finder(*assembly, graph);
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
    sheet.thrust_lines = sheet.closed ? by_azimuth : groups.size() > 2 || axis ? radial : none;
    report.kind = sheet.closed                   ? "rings about a vertical axis"
                  : sheet.thrust_lines == radial ? "from several springers or about the given axis"
                                                 : "a wall";
  }
  report.refusal = courses.refusal;
  const bool found = courses.refusal.empty();
  sheet.num_rings = found ? static_cast<int>(courses.stones.size()) : 0;
  report.courses = found ? sheet.num_rings : 0;
  if (found) Labels(courses, finder, graph, sheet, assembly).set();
  if (found || sheet.thrust_lines == radial) assembly->sheets = {sheet};
  return report;
}

}  // namespace cupola
