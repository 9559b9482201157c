#include "assembly/model/open_tops.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "assembly/model/joint_rule.hpp"

namespace cupola {
namespace {

/// Takes from convex polygons what lies below a convex face in plan.
std::vector<std::vector<Vec3>> outside_in_plan(const std::vector<std::vector<Vec3>>& polygons,
                                               const std::vector<Vec3>& face, double smallest_area) {
  std::vector<std::vector<Vec3>> kept;
  for (const std::vector<Vec3>& polygon : polygons) {
    std::vector<std::vector<Vec3>> pieces;
    std::vector<Vec3> inside = polygon;
    for (size_t i = 0; i < face.size() && inside.size() > 2; ++i) {
      const Vec3 along = face[(i + 1) % face.size()] - face[i];  // clockwise in plan, as the face looks down
      const Vec3 out(-along.y(), along.x(), 0.0);
      if (out.norm() == 0.0) continue;
      pieces.push_back(below_plane(inside, -out, -out.dot(face[i])));
      inside = below_plane(inside, out, out.dot(face[i]));
    }
    const auto is_nothing = [&](const std::vector<Vec3>& piece) {
      return piece.size() < 3 || polygon_area(piece) <= smallest_area;
    };
    if (is_nothing(inside)) pieces = {polygon};
    std::erase_if(pieces, is_nothing);
    std::ranges::move(pieces, std::back_inserter(kept));
  }
  return kept;
}

/// A part of the masonry's underside, up to the level to which it covers what lies below.
struct Soffit {
  std::vector<Vec3> polygon;
  Plane plane;
  Eigen::AlignedBox2d plan;
  int part = 0;
  double start = 0.0;  ///< m, along the longer side of the plan of all
};

Eigen::AlignedBox2d plan_of(const std::vector<Vec3>& polygon) {
  Eigen::AlignedBox2d plan;
  for (const Vec3& p : polygon) plan.extend(Eigen::Vector2d(p.head<2>()));
  return plan;
}

int member_of(const Assembly& assembly, int part) {
  return assembly.blocks[assembly.parts[part].block].member;
}

/// The soffits of all masonry.
class Cover {
 public:
  Cover(const Assembly& assembly, double level)
      : assembly_(assembly), margin_(joint_rule(smallest_block_size(assembly), 0.0).margin) {
    const double highest = level - 1e-3 * margin_;  // what lies at the level covers nothing, but for rounding
    Eigen::AlignedBox2d plan;
    for (int p = 0; p < static_cast<int>(assembly.parts.size()); ++p) {
      const Part& part = assembly.parts[p];
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
        const LoadedFace face = loaded_face(assembly, p, f);
        if (assembly.face_kinds[f] == FaceKind::internal || face.normal.z() >= -kUpright) continue;
        std::vector<Vec3> polygon = below_plane(face.polygon, Vec3::UnitZ(), highest);
        if (polygon.size() < 3) continue;
        const Eigen::AlignedBox2d of_soffit = plan_of(polygon);
        plan.extend(of_soffit);
        soffits_.push_back(
            {std::move(polygon), {face.normal, face.normal.dot(face.centroid)}, of_soffit, p, 0.0});
      }
    }
    if (soffits_.empty()) return;
    axis_ = plan.sizes().x() < plan.sizes().y() ? 1 : 0;
    for (Soffit& soffit : soffits_) {
      widest_ = std::max(widest_, soffit.plan.sizes()[axis_]);
      soffit.start = soffit.plan.min()[axis_];
    }
    std::ranges::sort(soffits_, {}, &Soffit::start);
  }

  /// Adds what no soffit covers of a face that looks up; notes the members that stand on that of the face.
  void add_open(const LoadedFace& face, std::vector<LoadedFace>* faces,
                std::set<std::pair<int, int>>* stands_on) const {
    const Eigen::AlignedBox2d plan = plan_of(face.polygon);
    const double height = face.normal.dot(face.centroid);
    std::vector<std::vector<Vec3>> open{face.polygon};
    auto s = std::ranges::lower_bound(soffits_, plan.min()[axis_] - widest_, {}, &Soffit::start);
    for (; s != soffits_.end() && s->start <= plan.max()[axis_]; ++s) {
      if (s->part == face.part || plan.intersection(s->plan).isEmpty()) continue;
      const std::vector<Vec3> above =
          below_plane(s->polygon, -face.normal, margin_ * face.normal.z() - height);
      if (above.size() < 3) continue;
      open = outside_in_plan(open, above, kNothing * face.area);
      const bool touches = s->plane.normal.dot(face.normal) < kNothing - 1.0 &&
                           std::abs(s->plane.offset + height) <= kNothing * std::sqrt(face.area);
      if (touches) stands_on->emplace(member_of(assembly_, s->part), member_of(assembly_, face.part));
    }
    for (std::vector<Vec3>& polygon : open) {
      const Vec3 centroid = polygon_centroid(polygon);
      const double area = polygon_area(polygon);
      faces->push_back({face.block, face.part, std::move(polygon), centroid, face.normal, area});
    }
  }

 private:
  static constexpr double kNothing = 1e-9;  // of the area of a face, and of its size: rounding

  const Assembly& assembly_;
  std::vector<Soffit> soffits_;
  double margin_ = 0.0;  // m, of height, by which a soffit may lie below what it covers: blocks overlap
  double widest_ = 0.0;  // m, of the soffits along the axis
  int axis_ = 0;
};

}  // namespace

std::vector<LoadedFace> open_parts(const Assembly& assembly, const std::vector<LoadedFace>& faces,
                                   double level) {
  const Cover cover(assembly, level);
  std::set<std::pair<int, int>> unused;
  std::vector<LoadedFace> open;
  for (const LoadedFace& face : faces)
    if (looks_up(face)) cover.add_open(face, &open, &unused);
  return open;
}

std::vector<LoadedFace> open_tops(const Assembly& assembly, int from_ring, int to_ring,
                                  const std::string& member, bool of_bearers, double level) {
  constexpr std::array kTops{FaceKind::top, FaceKind::free, FaceKind::bed, FaceKind::head, FaceKind::wythe};
  const Cover cover(assembly, level);
  std::set<std::pair<int, int>> stands_on;
  std::vector<LoadedFace> tops;
  for (const LoadedFace& face : faces_of_kind(assembly, kTops, from_ring, to_ring, ""))
    if (looks_up(face)) cover.add_open(face, &tops, &stands_on);
  const auto is_named = [&](int index) { return means_member(member, assembly, index); };
  if (member.empty()) return tops;
  std::erase_if(tops, [&](const LoadedFace& top) {
    const int of_top = member_of(assembly, top.part);
    if (!of_bearers) return !is_named(of_top);
    return std::ranges::none_of(stands_on, [&](const auto& pair) {
      return pair.first != of_top && pair.second == of_top && is_named(pair.first);
    });
  });
  return tops;
}

}  // namespace cupola
