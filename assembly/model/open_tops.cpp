#include "assembly/model/open_tops.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <Eigen/Geometry>

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

/// A face that looks down, and the member of its block.
struct Soffit {
  std::vector<Vec3> polygon;
  Plane plane;
  Eigen::AlignedBox2d plan;
  int member = 0;
};

Eigen::AlignedBox2d plan_of(const std::vector<Vec3>& polygon) {
  Eigen::AlignedBox2d plan;
  for (const Vec3& p : polygon) plan.extend(Eigen::Vector2d(p.head<2>()));
  return plan;
}

std::vector<Soffit> soffits(const Assembly& assembly) {
  std::vector<Soffit> found;
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] == FaceKind::internal) continue;
      std::vector<Vec3> polygon = face_points(assembly, f);
      const Plane plane = polygon_plane(polygon);
      if (plane.normal.z() >= -kUpright) continue;
      const Eigen::AlignedBox2d plan = plan_of(polygon);
      found.push_back({std::move(polygon), plane, plan, assembly.blocks[part.block].member});
    }
  return found;
}

/// A face that looks up, with the pieces of it that are open to the sky.
struct Top {
  LoadedFace face;
  std::vector<std::vector<Vec3>> open;
  int member = 0;
};

/// Takes what the soffits cover; notes the members that stand on that of the top.
void cover(std::span<const Soffit> soffits, Top* top, std::set<std::pair<int, int>>* stands_on) {
  constexpr double kNothing = 1e-9;  // of the area of a face, and of its size: rounding
  const double size = std::sqrt(top->face.area);
  const Eigen::AlignedBox2d plan = plan_of(top->face.polygon);
  for (const Soffit& soffit : soffits) {
    const double above = top->face.normal.dot(polygon_centroid(soffit.polygon) - top->face.centroid);
    if (above < -kNothing * size || plan.intersection(soffit.plan).isEmpty()) continue;
    top->open = outside_in_plan(top->open, soffit.polygon, kNothing * top->face.area);
    const bool touches = above <= kNothing * size && soffit.plane.normal.dot(top->face.normal) < kNothing - 1;
    if (touches && soffit.member != top->member) stands_on->emplace(soffit.member, top->member);
  }
}

}  // namespace

std::vector<LoadedFace> open_tops(const Assembly& assembly, int from_ring, int to_ring,
                                  const std::string& member, bool of_bearers) {
  std::map<int, int> last_ring;  // of members
  for (const Part& part : assembly.parts) {
    int& last = last_ring[assembly.blocks[part.block].member];
    last = std::max(last, part.ring);
  }
  const std::vector<Soffit> soffits_of_all = soffits(assembly);
  std::set<std::pair<int, int>> stands_on;
  std::vector<Top> tops;
  for (const Part& part : assembly.parts) {
    const Block& block = assembly.blocks[part.block];
    if (part.ring < from_ring || part.ring > to_ring || block.fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const FaceKind kind = assembly.face_kinds[f];
      const bool is_last_bed = kind == FaceKind::bed && part.ring == last_ring[block.member];
      if (kind != FaceKind::top && kind != FaceKind::free && !is_last_bed) continue;
      Top top{loaded_face(assembly, part.block, f), {}, block.member};
      if (!looks_up(top.face)) continue;
      top.open = {top.face.polygon};
      cover(soffits_of_all, &top, &stands_on);
      tops.push_back(std::move(top));
    }
  }
  const auto is_named = [&](int index) {
    return !assembly.members.empty() && assembly.members[index] == member;
  };
  const auto counts = [&](int of_top) {
    if (member.empty() || !of_bearers) return member.empty() || is_named(of_top);
    return std::ranges::any_of(
        stands_on, [&](const auto& pair) { return pair.second == of_top && is_named(pair.first); });
  };
  std::vector<LoadedFace> faces;
  for (const Top& top : tops) {
    if (!counts(top.member)) continue;
    for (const std::vector<Vec3>& polygon : top.open)
      faces.push_back(
          {top.face.block, polygon, polygon_centroid(polygon), top.face.normal, polygon_area(polygon)});
  }
  return faces;
}

}  // namespace cupola
