#include "generators/importer/course_labels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace cupola {
namespace {

constexpr double kRoundedAngle = 1e-12;  // rad

/// The sheet of the blocks, and for each free block the directions along its course (t) and upwards on its
/// bed (m).
class Labels {
 public:
  Labels(const Courses& courses, const CourseFinder& finder, const JointGraph& graph, const Sheet& sheet,
         Assembly* assembly)
      : courses_(courses), finder_(finder), graph_(graph), sheet_(sheet), assembly_(*assembly) {
    set_wall();
    for (const std::vector<int>& stones : courses.stones)
      in_layers_.push_back(
          std::ranges::any_of(stones, [&](int b) { return finder.beside(courses.course, b).size() > 2; }));
  }

  void set() {
    assembly_.num_rings = static_cast<int>(courses_.stones.size());
    for (int k = 0; k < assembly_.num_rings; ++k) {
      std::vector<int> stones = courses_.stones[k];
      if (sheet_.closed) std::ranges::sort(stones, {}, [&](int b) { return azimuth_of(b); });
      for (size_t slot = 0; slot < stones.size(); ++slot) {
        Block& block = assembly_.blocks[stones[slot]];
        block.ring = k;
        block.slot = static_cast<int>(slot);
        name_faces(stones[slot]);
      }
    }
    for (Part& part : assembly_.parts) {
      part.ring = assembly_.blocks[part.block].ring;
      if (assembly_.blocks[part.block].fixed) name_faces_of_support(part);
    }
  }

 private:
  const Vec3& centroid_of(int block) const { return assembly_.blocks[block].centroid; }

  /// rad, in [0, 2 pi), about the axis.
  double azimuth_of(int block) const {
    const Vec3 r = centroid_of(block) - sheet_.origin;
    const double angle = std::atan2(r.y(), r.x());
    return angle < -kRoundedAngle ? angle + 2.0 * std::numbers::pi : std::abs(angle);
  }

  /// Along the course: across an arch; from stone to stone, where each has two at most beside it; else about
  /// the axis or along the wall.
  Vec3 along(int b) const {
    if (sheet_.thrust_lines == Sheet::ThrustLines::one)
      // constant: outwards turns from the first springing to the last
      return Eigen::AngleAxisd(sheet_.turn, Vec3::UnitZ()) * Vec3::UnitY();
    const std::vector<int> next = finder_.beside(courses_.course, b);
    if (!next.empty() && !in_layers_[courses_.course[b]])
      return (centroid_of(next.back()) - centroid_of(next.size() > 1 ? next.front() : b)).stableNormalized();
    const std::optional<Vec3> outward = sheet_.outward(centroid_of(b));
    return outward ? Vec3::UnitZ().cross(*outward) : along_wall_;
  }

  /// The directions along and out of a wall: along the course of most stones, whose leaves lie side by side, in
  /// a pier of single stones along the longer side of all; out of it towards +y, of a wall along y towards +x.
  void set_wall() {
    const std::vector<int>& most = *std::ranges::max_element(courses_.stones, {}, &std::vector<int>::size);
    if (most.size() > 1) {
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      for (const int b : most) mean += centroid_of(b).head<2>() / static_cast<double>(most.size());
      Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
      for (const int b : most) {
        const Eigen::Vector2d r = centroid_of(b).head<2>() - mean;
        spread += r * r.transpose();
      }
      along_wall_.head<2>() = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
      along_wall_.z() = 0.0;
    } else {
      Eigen::AlignedBox3d box;
      for (const Part& part : assembly_.parts)
        for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
          for (const Vec3& corner : face_points(assembly_, f))
            if (!assembly_.blocks[part.block].fixed) box.extend(corner);
      along_wall_ = box.sizes().x() < box.sizes().y() ? Vec3::UnitY() : Vec3::UnitX();
    }
    constexpr double kAlongY = 1e-9;  // cosine, rounding
    out_of_wall_ = Vec3::UnitZ().cross(along_wall_);
    if ((std::abs(out_of_wall_.y()) > kAlongY ? out_of_wall_.y() : out_of_wall_.x()) < 0.0)
      out_of_wall_ = -out_of_wall_;
  }

  FaceKind kind_of_joint(int block, const std::vector<int>& others) const {
    const int k = courses_.course[block];
    const bool bed = std::ranges::any_of(others, [&](int other) { return courses_.course[other] != k; });
    return bed ? FaceKind::bed : FaceKind::head;
  }

  void name_faces(int b) {
    Vec3 m = Vec3::Zero();
    for (const int f : finder_.lower_bed(b)) {
      const std::vector<Vec3> polygon = face_points(assembly_, f);
      m -= polygon_area(polygon) * polygon_plane(polygon).normal;
    }
    m.stableNormalize();
    Vec3 t = along(b);
    t = (t - t.dot(m) * m).stableNormalized();
    Vec3 n = t.cross(m);
    if (sheet_.thrust_lines != Sheet::ThrustLines::one) {  // courses may run either way
      const std::optional<Vec3> outward = sheet_.outward(centroid_of(b));
      if (n.dot(outward.value_or(out_of_wall_)) < 0.0) n = -n;
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
  Vec3 along_wall_, out_of_wall_;  // horizontal unit vectors
  std::vector<bool> in_layers_;    // per course
};

}  // namespace

void label_courses(const Courses& courses, const CourseFinder& finder, const JointGraph& graph,
                   const Sheet& sheet, Assembly* assembly) {
  Labels(courses, finder, graph, sheet, assembly).set();
}

}  // namespace cupola
