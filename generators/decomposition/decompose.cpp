#include "generators/decomposition/decompose.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/decomposition/convex_hull.hpp"
#include "generators/decomposition/plane_voting.hpp"
#include "generators/decomposition/prism_partition.hpp"
#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

constexpr int kMostParts = 2000;    // per block
constexpr double kRounding = 1e-9;  // of the block size: smaller distances are rounding

/// The point from which the corners of a block are counted: the origin of the world up to 128 sizes away,
/// where rounding is some 1e-13 of the block, far below the tolerances of volumes. Corners less a multiple of
/// a power of two that is not below the size are exact.
Vec3 origin_near(const TriangleMesh& mesh) {
  constexpr double kNear = 128.0;  // sizes
  const double unit = std::exp2(std::ceil(std::log2(mesh_size(mesh))));
  const auto multiple = [&](double x) {
    return std::abs(x) < kNear * unit ? 0.0 : unit * std::round(x / unit);
  };
  return mesh.vertices.front().unaryExpr(multiple);
}

bool is_convex(const TriangleMesh& mesh, const std::vector<Facet>& facets, double tolerance) {
  for (const Facet& facet : facets)
    for (const Vec3& v : mesh.vertices)
      if (facet.plane.normal.dot(v) - facet.plane.offset > tolerance) return false;
  return true;
}

/// The block itself with one face per facet; none if the boundary of a facet is not a single loop.
std::optional<ConvexPolyhedron> as_polyhedron(const TriangleMesh& mesh, const std::vector<Facet>& facets) {
  ConvexPolyhedron solid;
  solid.vertices = mesh.vertices;
  for (const Facet& facet : facets) {
    solid.faces.push_back(facet_loop(mesh, facet));
    solid.planes.push_back(facet.plane);
    if (solid.faces.back().empty()) return std::nullopt;
  }
  return solid;
}

/// True if some of the block's surface lies in a face of a part.
bool contains_surface(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                      const ConvexPolyhedron& part, size_t face, double tolerance) {
  std::vector<Vec3> polygon;
  for (int v : part.faces[face]) polygon.push_back(part.vertices[v]);
  for (const Facet& facet : facets) {
    if (facet.plane.normal.dot(part.planes[face].normal) < 1.0 - 1e-9) continue;
    const bool same_plane = std::ranges::all_of(polygon, [&](const Vec3& p) {
      return std::abs(facet.plane.normal.dot(p) - facet.plane.offset) <= tolerance;
    });
    if (!same_plane) continue;
    for (int t : facet.triangles) {
      const std::vector<Vec3> triangle{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
      if (overlap_width(polygon, triangle, facet.plane.normal) > tolerance) return true;
    }
  }
  return false;
}

/// Drops the vertices inside an edge, which only two faces share. They come from merged facets and from cuts
/// through the end of an edge.
void drop_vertices_on_edges(ConvexPolyhedron* solid) {
  std::vector<int> num_faces(solid->vertices.size(), 0);
  for (const auto& face : solid->faces)
    for (int v : face) ++num_faces[v];
  std::vector<int> new_id(solid->vertices.size(), -1);
  std::vector<Vec3> kept;
  for (auto& face : solid->faces) {
    std::erase_if(face, [&](int v) { return num_faces[v] < 3; });
    for (int& v : face) {
      if (new_id[v] < 0) {
        new_id[v] = static_cast<int>(kept.size());
        kept.push_back(solid->vertices[v]);
      }
      v = new_id[v];
    }
  }
  solid->vertices = std::move(kept);
  for (size_t f = solid->faces.size(); f-- > 0;) {
    if (solid->faces[f].size() >= 3) continue;  // else a sliver between two faces
    solid->faces.erase(solid->faces.begin() + static_cast<std::ptrdiff_t>(f));
    solid->planes.erase(solid->planes.begin() + static_cast<std::ptrdiff_t>(f));
  }
}

/// The solid that the planes of the faces bound, within a box about the block. Unlike clipping with a
/// tolerance this gives exactly plane faces, however warped those of the block are.
ConvexPolyhedron between_planes(const TriangleMesh& mesh, const std::vector<Plane>& planes) {
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double size = (high - low).maxCoeff();
  ConvexPolyhedron solid = box_polyhedron(low - Vec3::Constant(size), high + Vec3::Constant(size));
  for (const Plane& plane : planes)
    if (!solid.empty()) solid = clip(solid, plane, kRounding * size);
  return solid;
}

/// True if each edge joins two faces.
bool is_closed(const ConvexPolyhedron& solid) {
  std::set<std::pair<int, int>> edges;
  for (const auto& face : solid.faces)
    for (size_t i = 0; i < face.size(); ++i)
      if (!edges.emplace(face[i], face[(i + 1) % face.size()]).second) return false;
  return std::ranges::all_of(edges, [&](const auto& edge) {
    return edges.contains({edge.second, edge.first});
  });
}

/// The convex hull of a part, with facets as in the block; its faces are plane within the unevenness of the
/// block.
ConvexPolyhedron hull_of(const ConvexPolyhedron& part, const DecompositionOptions& options) {
  const TriangleMesh hull = convex_hull(part.vertices);
  if (hull.triangles.empty()) return {};
  std::vector<int> facet_of;
  std::optional<ConvexPolyhedron> solid =
      as_polyhedron(hull, find_facets(hull, options.facet_angle, options.flat * mesh_size(hull), &facet_of));
  if (solid) return *solid;
  return as_polyhedron(hull, find_facets(hull, kRounding, kRounding, &facet_of)).value_or(ConvexPolyhedron{});
}

/// A part of a block whose faces are not plane, with plane faces: the solid between the planes of its facets;
/// its hull where the planes leave a face out.
ConvexPolyhedron flattened(const TriangleMesh& mesh, const ConvexPolyhedron& part,
                           const DecompositionOptions& options) {
  ConvexPolyhedron solid = between_planes(mesh, part.planes);
  drop_vertices_on_edges(&solid);
  if (!solid.empty() && is_closed(solid)) return solid;
  return hull_of(part, options);
}

double volume_of(const std::vector<ConvexPolyhedron>& parts) {
  double volume = 0.0;
  for (const ConvexPolyhedron& part : parts) volume += polyhedron_volume(part);
  return volume;
}

/// decompose() of a block whose coordinates are of its size.
Decomposition decompose_near(const TriangleMesh& mesh, const std::string& name,
                             const DecompositionOptions& options) {
  const double size = mesh_size(mesh);
  std::vector<int> facet_of;
  const std::vector<Facet> facets = find_facets(mesh, options.facet_angle, options.flat * size, &facet_of);
  CUPOLA_ASSERT(facet_of.size() == mesh.triangles.size());
  const double noise = 4.0 * unevenness(mesh, facets);  // m
  double area = 0.0;
  for (const Facet& facet : facets) area += facet.area;

  Decomposition result;
  result.volume = mesh_volume(mesh);
  const double bound = std::max(1e-9 * result.volume, noise * area);
  const auto accept = [&](std::vector<ConvexPolyhedron> parts, Decomposition::Method method) {
    for (ConvexPolyhedron& part : parts) {
      if (noise > kRounding * size && method != Decomposition::Method::nef)
        part = flattened(mesh, part, options);
      drop_vertices_on_edges(&part);
    }
    std::erase_if(parts, [](const ConvexPolyhedron& part) { return part.empty(); });
    result.volume_error = volume_of(parts) - result.volume;
    result.method = method;
    result.parts = std::move(parts);
    return !result.parts.empty() && std::abs(result.volume_error) <= bound;
  };

  const std::optional<ConvexPolyhedron> whole =
      is_convex(mesh, facets, std::max(1e-9 * size, noise)) ? as_polyhedron(mesh, facets) : std::nullopt;
  bool done = whole && accept({*whole}, Decomposition::Method::already_convex);
  if (!done) {
    std::vector<ConvexPolyhedron> prisms = partition_prism(mesh, facets, facet_of, options.facet_angle);
    std::vector<ConvexPolyhedron> pieces =
        decompose_by_planes(mesh, facets, find_reflex_edges(mesh, facets, facet_of, options.facet_angle),
                            prisms.empty() ? kMostParts : static_cast<int>(prisms.size()));
    done = (!pieces.empty() && accept(std::move(pieces), Decomposition::Method::planes)) ||
           accept(std::move(prisms), Decomposition::Method::prism) ||
           accept(decompose_by_nef(mesh), Decomposition::Method::nef);
  }
  if (!done)
    throw InputError(fmt::format(
        "block {}: cannot be split into convex parts: their volume differs from the block's by {:.3g} m3; "
        "simplify the block or increase geometry.import.facet_angle",
        name, result.volume_error));

  const double tolerance = std::max(1e-8 * size, noise);
  for (const ConvexPolyhedron& part : result.parts) {
    result.internal.emplace_back();
    for (size_t f = 0; f < part.faces.size(); ++f)
      result.internal.back().push_back(result.parts.size() > 1 &&
                                       !contains_surface(mesh, facets, part, f, tolerance));
  }
  return result;
}

}  // namespace

Decomposition decompose(const TriangleMesh& mesh, const std::string& name,
                        const DecompositionOptions& options) {
  const Vec3 origin = origin_near(mesh);
  if (origin.isZero(0.0)) return decompose_near(mesh, name, options);
  TriangleMesh near = mesh;
  for (Vec3& vertex : near.vertices) vertex -= origin;
  Decomposition pieces = decompose_near(near, name, options);
  for (ConvexPolyhedron& part : pieces.parts) {
    for (Vec3& vertex : part.vertices) vertex += origin;
    for (Plane& plane : part.planes) plane.offset += plane.normal.dot(origin);
  }
  return pieces;
}

}  // namespace cupola
