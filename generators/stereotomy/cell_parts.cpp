#include "generators/stereotomy/cell_parts.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/convex_clip.hpp"

namespace cupola {
namespace {

using Quad = std::array<int, 4>;  // vertex ids

/// Corners and faces of a hexahedral cell. Corners of a layer are in the order lower left, lower right, upper
/// right, upper left, seen from outside; side i lies between the corners i and i + 1.
struct Hexahedron {
  Quad inner, outer;
  FaceKind inner_kind, outer_kind;
  std::array<FaceKind, 4> sides;  // lower bed, right head, upper bed, left head
};

void start_part(const CellGrid& grid, const CellRange& cells, Assembly* assembly) {
  Part part;
  part.block = static_cast<int>(assembly->blocks.size()) - 1;
  part.ring = assembly->blocks.back().fixed ? -1 : grid.ring_of(cells.row_start);
  part.slice = grid.wrap(cells.row_start, cells.slice_start);
  part.wythe = cells.wythe_start;
  part.face_start = assembly->num_faces();
  assembly->parts.push_back(part);
}

/// Adds a face between layers: the quad if it is plane, else two triangles along the diagonal that keeps the
/// cell convex.
void add_layer(const Quad& quad, FaceKind kind, bool flat, Assembly* assembly) {
  if (flat) {
    assembly->add_face(quad, kind);
    return;
  }
  const auto& p = assembly->vertices;
  const Vec3 normal = (p[quad[1]] - p[quad[0]]).cross(p[quad[2]] - p[quad[0]]);
  const int first = normal.dot(p[quad[3]] - p[quad[0]]) <= 0.0 ? 0 : 1;
  const auto corner = [&](int i) { return quad[(first + i) % 4]; };
  assembly->add_face(std::array{corner(0), corner(1), corner(2)}, kind);
  assembly->add_face(std::array{corner(0), corner(2), corner(3)}, kind);
}

/// Faces are counter-clockwise seen from outside, because (outwards, along, up) is a right-handed frame on
/// every surface.
void add_hexahedron_faces(const Hexahedron& cell, bool flat, Assembly* assembly) {
  const auto& [p, q] = std::pair(cell.inner, cell.outer);
  assembly->add_face(std::array{p[0], p[1], q[1], q[0]}, cell.sides[0]);
  assembly->add_face(std::array{p[3], q[3], q[2], p[2]}, cell.sides[2]);
  assembly->add_face(std::array{p[0], q[0], q[3], p[3]}, cell.sides[3]);
  assembly->add_face(std::array{p[1], p[2], q[2], q[1]}, cell.sides[1]);
  add_layer({p[0], p[3], p[2], p[1]}, cell.inner_kind, flat, assembly);
  add_layer(q, cell.outer_kind, flat, assembly);
}

struct Face {
  std::vector<int> vertices;  // in either direction
  FaceKind kind;
};

/// Adds the faces of a convex part, each counter-clockwise seen from outside.
void add_convex(std::initializer_list<Face> faces, Assembly* assembly) {
  Vec3 inside = Vec3::Zero();
  int count = 0;
  for (const Face& face : faces)
    for (const int v : face.vertices) {
      inside += assembly->vertices[v];
      ++count;
    }
  inside /= count;
  for (Face face : faces) {
    std::vector<Vec3> corners;
    for (const int v : face.vertices) corners.push_back(assembly->vertices[v]);
    const Plane plane = polygon_plane(corners);
    if (plane.normal.dot(inside) > plane.offset) std::ranges::reverse(face.vertices);
    assembly->add_face(face.vertices, face.kind);
  }
}

/// Cuts a cell whose inner layer has a valley from corner 0 to corner 2, see the header.
void add_cut_cell(const CellGrid& grid, const CellRange& range, const Hexahedron& cell, Assembly* assembly) {
  const auto& [p, q] = std::pair(cell.inner, cell.outer);
  const auto& x = assembly->vertices;
  const FaceKind internal = FaceKind::internal;
  // The cut is bent along p0 - q2. It bulges away from the corner `near`, whose prism is therefore convex.
  const Vec3 normal = (x[p[2]] - x[p[0]]).cross(x[q[2]] - x[p[0]]);
  const bool third = normal.dot(x[p[3]] - x[p[0]]) * normal.dot(x[q[0]] - x[p[0]]) >= 0.0;
  const int near = third ? 3 : 1, far = 4 - near;
  const auto side = [&](int corner, int end) {
    return cell.sides[end == 0 ? (corner == 1 ? 0 : 3) : (corner == 1 ? 1 : 2)];
  };
  start_part(grid, range, assembly);
  add_convex({{{p[0], p[near], p[2]}, cell.inner_kind},
              {{q[0], q[near], q[2]}, cell.outer_kind},
              {{p[0], p[near], q[near], q[0]}, side(near, 0)},
              {{p[near], p[2], q[2], q[near]}, side(near, 2)},
              {{p[0], p[2], q[2]}, internal},
              {{p[0], q[2], q[0]}, internal}},
             assembly);
  start_part(grid, range, assembly);
  add_convex({{{q[0], q[far], q[2]}, cell.outer_kind},
              {{p[0], q[0], q[far]}, side(far, 0)},
              {{p[0], q[0], q[2]}, internal},
              {{p[0], q[2], q[far]}, internal}},
             assembly);
  start_part(grid, range, assembly);
  add_convex({{{p[0], p[2], p[far]}, cell.inner_kind},
              {{p[0], p[far], q[far]}, side(far, 0)},
              {{p[2], p[far], q[far], q[2]}, side(far, 2)},
              {{p[0], p[2], q[2]}, internal},
              {{p[0], q[2], q[far]}, internal}},
             assembly);
}

/// The same cell with corner 1 in place of corner 0.
Hexahedron turned(const Hexahedron& cell) {
  Hexahedron out = cell;
  std::rotate(out.inner.begin(), out.inner.begin() + 1, out.inner.end());
  std::rotate(out.outer.begin(), out.outer.begin() + 1, out.outer.end());
  std::rotate(out.sides.begin(), out.sides.begin() + 1, out.sides.end());
  return out;
}

}  // namespace

void add_parts(const CellGrid& grid, const CellRange& cells, GridPoints* points, Assembly* assembly) {
  Hexahedron cell{};
  for (const bool upper : {false, true})
    for (const bool outer : {false, true})
      for (const bool right : {false, true})
        (outer ? cell.outer : cell.inner)[upper ? (right ? 2 : 3) : (right ? 1 : 0)] =
            points->vertex(cells.row_start, upper ? cells.row_end : cells.row_start,
                           right ? cells.slice_end : cells.slice_start,
                           outer ? cells.wythe_end : cells.wythe_start, assembly);
  cell.inner_kind = layer_kind(grid, cells, false);
  cell.outer_kind = layer_kind(grid, cells, true);
  cell.sides = {bed_kind(grid, cells, false), head_kind(grid, cells, true), bed_kind(grid, cells, true),
                head_kind(grid, cells, false)};
  const bool mates_inside = cell.inner_kind == FaceKind::wythe || cell.inner_kind == FaceKind::internal;
  if (!points->flat_skins() && mates_inside) {
    const bool rising = points->bulges_along_rising_diagonal(cells.row_start, cells.slice_start);
    add_cut_cell(grid, cells, rising ? cell : turned(cell), assembly);
    return;
  }
  start_part(grid, cells, assembly);
  add_hexahedron_faces(cell, points->flat_skins(), assembly);
}

void refuse_inverted_parts(const Assembly& assembly, size_t first, const std::string& key) {
  for (size_t p = first; p < assembly.parts.size(); ++p) {
    const Part& part = assembly.parts[p];
    if (volume_of(assembly, piece_of(assembly, part)) > 0.0) continue;
    const Vec3 at = polygon_centroid(face_points(assembly, part.face_start));
    throw InputError(
        fmt::format("{}: block {} about ({:.4g}, {:.4g}, {:.4g}) m is inside out, because its beds or its "
                    "skins meet inside the shell: choose a smaller thickness, a larger eye or other `beds`",
                    key, part.block, at.x(), at.y(), at.z()));
  }
}

}  // namespace cupola
