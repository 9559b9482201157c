#include "generators/decomposition/plane_voting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

namespace cupola {
namespace {

constexpr double kLength = 1e-9;   // times the block size: smaller distances count as zero
constexpr double kAngle = 1e-6;    // rad: smaller angles count as zero
constexpr double kSliver = 0.2;    // rad, 11 deg
constexpr double kVolume = 1e-11;  // times the block volume: smaller differences of volume count as zero
constexpr size_t kMostPairs = 40;  // with more reflex edges in a cell, only some pairs are tried

struct Slicer {
  const TriangleMesh& mesh;
  const std::vector<Facet>& facets;
  const std::vector<ReflexEdge>& edges;
  int most_parts;
  double length, volume;                       // tolerances, m and m3
  std::vector<std::array<int, 3>> neighbours;  // as triangle_neighbours returns them
  std::vector<ConvexPolyhedron> parts{};
  bool failed = false;
};

/// Height of a point above a plane, m.
double height(const Plane& plane, const Vec3& p) {
  return plane.normal.dot(p) - plane.offset;
}

/// True if a piece of the edge longer than `tolerance` (m) lies in the interior of the cell.
bool passes_inside(const ReflexEdge& edge, const ConvexPolyhedron& cell, double tolerance) {
  double from = 0.0, to = 1.0;
  for (const Plane& plane : cell.planes) {
    const double a = height(plane, edge.start) + tolerance, b = height(plane, edge.end) + tolerance;
    if (a > 0.0 && b > 0.0) return false;
    if (a <= 0.0 && b <= 0.0) continue;
    const double crossing = a / (a - b);
    if (a > 0.0)
      from = std::max(from, crossing);
    else
      to = std::min(to, crossing);
  }
  return (to - from) * (edge.end - edge.start).norm() > tolerance;
}

/// True if the plane contains the edge and leaves less than 180 deg of solid on both sides.
bool resolves(const Slicer& s, const Plane& plane, const ReflexEdge& edge) {
  if (std::abs(height(plane, edge.start)) > s.length || std::abs(height(plane, edge.end)) > s.length)
    return false;
  const Vec3 inward = plane.normal.cross((edge.end - edge.start).normalized());
  const double a = s.facets[edge.facet_a].plane.normal.dot(inward);
  const double b = s.facets[edge.facet_b].plane.normal.dot(inward);
  return (a <= kAngle && b <= kAngle) || (a >= -kAngle && b >= -kAngle);
}

/// Number of separate limbs of the solid that a plane cuts, counting the triangles that reach into a cell.
/// Corners in the plane count as below it.
int num_limbs_cut(const Slicer& s, const Plane& plane, const std::vector<char>& in_cell) {
  const auto num_triangles = static_cast<int>(s.mesh.triangles.size());
  const auto above = [&](int t, int i) { return height(plane, s.mesh.corner(t, i)) > s.length; };
  std::vector<char> open(in_cell.size(), 0);  // 1: cut by the plane and not counted yet
  for (int t = 0; t < num_triangles; ++t)
    open[t] = in_cell[t] && (above(t, 0) != above(t, 1) || above(t, 0) != above(t, 2));
  int count = 0;
  for (int seed = 0; seed < num_triangles; ++seed) {
    if (!open[seed]) continue;
    ++count;
    open[seed] = 0;
    for (std::vector<int> stack{seed}; !stack.empty();) {
      const int t = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const int next = s.neighbours[t][i];
        if (next < 0 || !open[next] || above(t, i) == above(t, (i + 1) % 3)) continue;
        open[next] = 0;
        stack.push_back(next);
      }
    }
  }
  return count;
}

/// Score of a plane for the active edges and the triangles in a cell (see the header); none if it resolves no
/// edge. Ties go to the plane that divides the edges more evenly.
std::optional<double> score(const Slicer& s, const Plane& plane, const std::vector<int>& active,
                            const std::vector<char>& in_cell) {
  double votes = 0.0;
  int continued = 0;
  bool sliver = false;
  int above = 0, below = 0;
  for (int e : active) {
    const ReflexEdge& edge = s.edges[e];
    const double middle = height(plane, 0.5 * (edge.start + edge.end));
    above += middle > s.length ? 1 : 0;
    below += middle < -s.length ? 1 : 0;
    if (!resolves(s, plane, edge)) continue;
    votes += 1.0;
    bool continues = false;
    for (int f : {edge.facet_a, edge.facet_b}) {
      const double sine = s.facets[f].plane.normal.cross(plane.normal).norm();
      sliver = sliver || (sine > kAngle && sine < kSliver);
      continues = continues || sine <= kAngle;
    }
    continued += continues ? 1 : 0;
  }
  if (votes == 0.0) return std::nullopt;
  const int limbs = num_limbs_cut(s, plane, in_cell);
  const double imbalance = static_cast<double>(std::abs(above - below)) / static_cast<double>(active.size());
  return votes + 0.2 * std::min(continued, 2) - std::max(0, limbs - 1) - (sliver ? 0.5 : 0.0) -
         1e-3 * imbalance;
}

Plane plane_through(const Vec3& normal, const Vec3& point) {
  const Vec3 unit = normal.normalized();
  return {unit, unit.dot(point)};
}

std::vector<Plane> candidates(const Slicer& s, const std::vector<int>& active) {
  std::vector<Plane> planes;
  for (int e : active) {
    const ReflexEdge& edge = s.edges[e];
    const Vec3 along = (edge.end - edge.start).normalized();
    const Vec3 na = s.facets[edge.facet_a].plane.normal, nb = s.facets[edge.facet_b].plane.normal;
    for (const Vec3& n : {na, nb}) planes.push_back(plane_through(n - n.dot(along) * along, edge.start));
    if ((na + nb).norm() > kAngle)
      planes.push_back(plane_through(along.cross(na + nb), edge.start));  // bisector
  }
  const size_t stride = (active.size() + kMostPairs - 1) / kMostPairs;
  for (size_t i = 0; i < active.size(); i += stride)
    for (size_t j = i + stride; j < active.size(); j += stride) {
      const ReflexEdge& a = s.edges[active[i]];
      const ReflexEdge& b = s.edges[active[j]];
      const Vec3 along = a.end - a.start;
      Vec3 normal = along.cross(b.start - a.start);
      if (normal.norm() <= s.length * along.norm()) normal = along.cross(b.end - a.start);
      if (normal.norm() <= s.length * along.norm()) continue;  // the edges lie on one line
      const Plane plane = plane_through(normal, a.start);
      if (std::abs(height(plane, b.start)) <= s.length && std::abs(height(plane, b.end)) <= s.length)
        planes.push_back(plane);
    }
  return planes;
}

/// True if part of a triangle lies strictly inside a cell.
bool reaches_inside(const Slicer& s, int triangle, const ConvexPolyhedron& cell) {
  std::vector<Vec3> polygon;
  for (int i = 0; i < 3; ++i) polygon.push_back(s.mesh.corner(triangle, i));
  for (const Plane& plane : cell.planes) {
    std::vector<Vec3> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double hp = height(plane, p) + s.length, hq = height(plane, q) + s.length;
      if (hp <= 0.0) kept.push_back(p);
      if (hp * hq < 0.0) kept.push_back(p + hp / (hp - hq) * (q - p));
    }
    polygon = std::move(kept);
    if (polygon.size() < 3) return false;
  }
  return polygon_area(polygon) > s.length * s.length;
}

/// Volume of the solid inside a convex cell, m3: the sum of signed tetrahedra over the triangles, clipped to
/// the cell.
double solid_volume_in(const Slicer& s, const ConvexPolyhedron& cell) {
  const Vec3 apex = vertex_mean(cell);
  double volume = 0.0;
  for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t) {
    const Vec3 &a = s.mesh.corner(t, 0), &b = s.mesh.corner(t, 1), &c = s.mesh.corner(t, 2);
    const double six = (a - apex).dot((b - apex).cross(c - apex));
    if (std::abs(six) <= 1e-3 * s.volume / static_cast<double>(s.mesh.triangles.size())) continue;
    ConvexPolyhedron piece = tetrahedron(apex, a, b, c);
    for (const Plane& plane : cell.planes) {
      if (piece.empty()) break;
      piece = clip(piece, plane, s.length);  // rounding of a face in the plane must not wind about it
    }
    if (!piece.empty()) volume += std::copysign(polyhedron_volume(piece), six);
  }
  return volume;
}

void slice(Slicer* s, const ConvexPolyhedron& cell, const std::vector<int>& edges);

void split(Slicer* s, const ConvexPolyhedron& cell, const Plane& plane, const std::vector<int>& edges) {
  slice(s, clip(cell, plane, s->length), edges);
  slice(s, clip(cell, Plane{-plane.normal, -plane.offset}, s->length), edges);
}

/// The plane of a facet that has some of the cell's solid on its outer side, and so separates pieces of it.
std::optional<Plane> separating_facet(const Slicer& s, const ConvexPolyhedron& cell,
                                      const std::vector<int>& inside) {
  for (int f : inside) {
    const Plane& plane = s.facets[f].plane;
    const ConvexPolyhedron outer = clip(cell, Plane{-plane.normal, -plane.offset}, s.length);
    if (!outer.empty() && !clip(cell, plane, s.length).empty() && solid_volume_in(s, outer) > s.volume)
      return plane;
  }
  return std::nullopt;
}

/// Appends the solid in a cell without reflex edges: the cell clipped by its facets, or several such pieces.
void finish_cell(Slicer* s, const ConvexPolyhedron& cell) {
  std::vector<int> inside;
  for (size_t f = 0; f < s->facets.size(); ++f)
    if (std::ranges::any_of(s->facets[f].triangles, [&](int t) { return reaches_inside(*s, t, cell); }))
      inside.push_back(static_cast<int>(f));
  if (inside.empty()) {
    if (winding_number(s->mesh, vertex_mean(cell)) > 0.5) s->parts.push_back(cell);
    return;
  }
  ConvexPolyhedron part = cell;
  for (int f : inside)
    if (!part.empty()) part = clip(part, s->facets[f].plane, s->length);
  const double volume = part.empty() ? 0.0 : polyhedron_volume(part);
  if (std::abs(volume - solid_volume_in(*s, cell)) <= s->volume) {
    if (!part.empty()) s->parts.push_back(part);
    return;
  }
  if (const std::optional<Plane> plane = separating_facet(*s, cell, inside))
    split(s, cell, *plane, {});
  else
    s->failed = true;
}

void slice(Slicer* s, const ConvexPolyhedron& cell, const std::vector<int>& edges) {
  if (s->failed || cell.empty()) return;
  if (static_cast<int>(s->parts.size()) > s->most_parts) {
    s->failed = true;
    return;
  }
  std::vector<int> active;
  for (int e : edges)
    if (passes_inside(s->edges[e], cell, s->length)) active.push_back(e);
  if (active.empty()) {
    finish_cell(s, cell);
    return;
  }
  std::vector<char> in_cell(s->mesh.triangles.size(), 0);
  for (int t = 0; t < static_cast<int>(in_cell.size()); ++t) in_cell[t] = reaches_inside(*s, t, cell);
  double best = -std::numeric_limits<double>::infinity();
  std::optional<Plane> chosen;
  for (const Plane& plane : candidates(*s, active)) {
    const std::optional<double> value = score(*s, plane, active, in_cell);
    if (!value || *value <= best) continue;
    best = *value;
    chosen = plane;
  }
  if (!chosen) {
    s->failed = true;
    return;
  }
  split(s, cell, *chosen, active);
}

}  // namespace

std::vector<ConvexPolyhedron> decompose_by_planes(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                                  const std::vector<ReflexEdge>& reflex_edges,
                                                  int most_parts) {
  const double size = mesh_size(mesh);
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  double area = 0.0;
  for (const Facet& facet : facets) area += facet.area;
  const double noise = 4.0 * unevenness(mesh, facets);
  Slicer slicer{mesh,
                facets,
                reflex_edges,
                most_parts,
                std::max(kLength * size, noise),
                std::max(kVolume * mesh_volume(mesh), noise * area),
                triangle_neighbours(mesh)};
  std::vector<int> all;
  for (size_t e = 0; e < reflex_edges.size(); ++e) all.push_back(static_cast<int>(e));
  const Vec3 margin = Vec3::Constant(0.1 * size);
  slice(&slicer, box_polyhedron(low - margin, high + margin), all);
  if (slicer.failed || static_cast<int>(slicer.parts.size()) > most_parts) return {};
  return slicer.parts;
}

}  // namespace cupola
