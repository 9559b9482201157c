#include "generators/stereotomy/convex_clip.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Geometry>

#include "assembly/model/joint_rule.hpp"
#include "generators/stereotomy/separation.hpp"

namespace cupola {

ConvexPiece piece_of(const Assembly& assembly, const Part& part) {
  ConvexPiece piece;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const auto ids = assembly.face(f);
    piece.faces.push_back({{ids.begin(), ids.end()}, assembly.face_kinds[f], -1});
  }
  return piece;
}

std::vector<Vec3> points_of(const Assembly& assembly, const ConvexPiece::Face& face) {
  std::vector<Vec3> points;
  for (const int v : face.vertices) points.push_back(assembly.vertices[v]);
  return points;
}

double volume_of(const Assembly& assembly, const ConvexPiece& piece) {
  const Vec3& origin = assembly.vertices[piece.faces.front().vertices.front()];
  double six_volumes = 0.0;
  for (const ConvexPiece::Face& face : piece.faces) {
    const std::vector<Vec3> p = points_of(assembly, face);
    for (size_t i = 1; i + 1 < p.size(); ++i)
      six_volumes += (p[0] - origin).dot((p[i] - origin).cross(p[i + 1] - origin));
  }
  return six_volumes / 6.0;
}

double shared_width(const Assembly& assembly, const ConvexPiece& a, const ConvexPiece& b, double rounding,
                    double gap) {
  const double opposed = gap > 0.0 ? -std::cos(JointRule{}.max_angle) : -1.0 + 1e-9;
  double widest = 0.0;
  for (const ConvexPiece::Face& f : a.faces) {
    const std::vector<Vec3> of_a = points_of(assembly, f);
    const Plane plane = polygon_plane(of_a);
    for (const ConvexPiece::Face& g : b.faces) {
      const std::vector<Vec3> of_b = points_of(assembly, g);
      if (plane.normal.dot(polygon_plane(of_b).normal) > opposed) continue;
      if (std::abs(plane.normal.dot(polygon_centroid(of_b)) - plane.offset) > gap + 10.0 * rounding) continue;
      widest = std::max(widest, overlap_width(of_a, of_b, plane.normal));
    }
  }
  return widest > 1e3 * rounding ? widest : 0.0;
}

ConvexClip::ConvexClip(std::vector<Plane> body, double rounding, Assembly* assembly)
    : body_(std::move(body)), rounding_(rounding), assembly_(assembly) {}

double ConvexClip::height(int vertex, int plane) const {
  const double h = body_[plane].normal.dot(assembly_->vertices[vertex]) - body_[plane].offset;
  return std::abs(h) < rounding_ ? 0.0 : h;
}

int ConvexClip::meeting(int a, int b, int plane) {
  const auto [low, high] = std::minmax(a, b);
  const auto [found, is_new] =
      meetings_.try_emplace({low, high, plane}, static_cast<int>(assembly_->vertices.size()));
  if (!is_new) return found->second;
  const double h = height(low, plane), k = height(high, plane), share = h / (h - k);
  assembly_->vertices.emplace_back((1.0 - share) * assembly_->vertices[low] +
                                   share * assembly_->vertices[high]);
  if (!assembly_->vertex_layers.empty()) {
    const auto layer = [&](int v) { return assembly_->vertex_layers[v]; };
    const auto depth = [&](int v) { return assembly_->vertex_depths[v]; };
    const int common = layer(low) == layer(high) ? layer(low) : -1;
    const double between = (1.0 - share) * depth(low) + share * depth(high);
    assembly_->vertex_layers.push_back(common);
    assembly_->vertex_depths.push_back(depth(low) == depth(high) ? depth(low) : between);
  }
  return found->second;
}

ConvexPiece ConvexClip::half(const ConvexPiece& piece, int plane, bool below) {
  const double sign = below ? 1.0 : -1.0;
  const auto above = [&](int v) { return sign * height(v, plane); };  // > 0: cut away
  bool any_kept = false, any_lost = false;
  for (const ConvexPiece::Face& face : piece.faces)
    for (const int v : face.vertices) {
      any_kept = any_kept || above(v) < 0.0;
      any_lost = any_lost || above(v) > 0.0;
    }
  if (!any_kept) return {};
  if (!any_lost) return piece;
  ConvexPiece out;
  std::set<int> rim;
  for (const ConvexPiece::Face& face : piece.faces) {
    ConvexPiece::Face kept{{}, face.kind, face.plane};
    const size_t n = face.vertices.size();
    for (size_t i = 0; i < n; ++i) {
      const int a = face.vertices[i], b = face.vertices[(i + 1) % n];
      if (above(a) <= 0.0) kept.vertices.push_back(a);
      if (above(a) * above(b) < 0.0) kept.vertices.push_back(meeting(a, b, plane));
    }
    const bool inside = std::ranges::any_of(kept.vertices, [&](int v) { return above(v) < 0.0; });
    if (!inside || kept.vertices.size() < 3) continue;
    for (const int v : kept.vertices)
      if (above(v) == 0.0) rim.insert(v);
    out.faces.push_back(std::move(kept));
  }
  Vec3 middle = Vec3::Zero();
  for (const int v : rim) middle += assembly_->vertices[v] / static_cast<double>(rim.size());
  const Vec3 outward = sign * body_[plane].normal;
  const Vec3 x = outward.unitOrthogonal(), y = outward.cross(x);
  ConvexPiece::Face cap{{rim.begin(), rim.end()}, FaceKind::free, plane};
  std::ranges::sort(cap.vertices, {}, [&](int v) {
    const Vec3 p = assembly_->vertices[v] - middle;
    return std::atan2(p.dot(y), p.dot(x));
  });
  if (cap.vertices.size() >= 3) out.faces.push_back(std::move(cap));
  return out;
}

std::vector<ConvexPiece> ConvexClip::outside(const ConvexPiece& piece) {
  std::vector<ConvexPiece> pieces;
  ConvexPiece rest = piece;
  for (int plane = 0; plane < static_cast<int>(body_.size()); ++plane) {
    ConvexPiece part = half(rest, plane, false);
    rest = half(rest, plane, true);
    if (rest.faces.empty()) return {piece};
    if (!part.faces.empty()) pieces.push_back(std::move(part));
  }
  return pieces;
}

ConvexPiece ConvexClip::inside(const ConvexPiece& piece) {
  ConvexPiece rest = piece;
  for (int plane = 0; plane < static_cast<int>(body_.size()) && !rest.faces.empty(); ++plane)
    rest = half(rest, plane, true);
  return rest;
}

}  // namespace cupola
