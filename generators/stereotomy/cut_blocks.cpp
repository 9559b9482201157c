#include "generators/stereotomy/cut_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/cell_grid.hpp"
#include "generators/stereotomy/grid_points.hpp"
#include "generators/stereotomy/support.hpp"

namespace cupola {
namespace {

/// Adds a skin face: the quad if it is plane, else two triangles along the diagonal that keeps the cell
/// convex.
void add_skin(const std::array<int, 4>& quad, FaceKind kind, bool flat, Assembly* assembly) {
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

void add_part(const CellGrid& grid, int block, const CellRange& cells, GridPoints* points,
              Assembly* assembly) {
  Part part;
  part.block = block;
  part.ring = assembly->blocks[block].fixed ? -1 : grid.ring_of(cells.row_start);
  part.slice = grid.wrap(cells.slice_start);
  part.face_start = assembly->num_faces();
  assembly->parts.push_back(part);

  // Corner names: lower / upper bed, left / right head, intrados / extrados. Faces are counter-clockwise seen
  // from outside, because (outwards, along, up) is a right-handed frame on every surface.
  const auto corner = [&](bool upper, bool right, Skin skin) {
    return points->vertex(upper ? cells.row_end : cells.row_start,
                          right ? cells.slice_end : cells.slice_start, skin, &assembly->vertices);
  };
  const auto [in, out] = std::pair(Skin::intrados, Skin::extrados);
  const int lli = corner(false, false, in), lri = corner(false, true, in);
  const int lle = corner(false, false, out), lre = corner(false, true, out);
  const int uli = corner(true, false, in), uri = corner(true, true, in);
  const int ule = corner(true, false, out), ure = corner(true, true, out);
  assembly->add_face(std::array{lli, lri, lre, lle}, bed_kind(grid, cells, false));
  assembly->add_face(std::array{uli, ule, ure, uri}, bed_kind(grid, cells, true));
  assembly->add_face(std::array{lli, lle, ule, uli}, head_kind(grid, cells, false));
  assembly->add_face(std::array{lri, uri, ure, lre}, head_kind(grid, cells, true));
  add_skin({lli, uli, uri, lri}, FaceKind::intrados, points->flat_skins(), assembly);
  add_skin({lle, lre, ure, ule}, FaceKind::extrados, points->flat_skins(), assembly);
}

/// Sets the sail of the block's middle, the position in it, and whether a corner of the surface lies inside
/// the block.
void set_sail(const CellGrid& grid, std::pair<int, int> slices, Block* block) {
  const SurfaceMap& surface = grid.surface;
  if (surface.sail_width == 0.0) return;
  const auto [start, end] = slices;
  for (int cut = start + 1; cut < end; ++cut) block->rib = block->rib || grid.is_corner(cut);
  const int num_sails = static_cast<int>(std::lround(2.0 * std::numbers::pi / surface.sail_width));
  const double middle =
      (0.5 * (grid.abscissa(start) + grid.abscissa(end)) - surface.first_corner) / surface.sail_width;
  const double sail =
      std::floor(middle + 1e-9);  // a middle on a corner belongs to the sail that begins there
  block->sail = (static_cast<int>(sail) % num_sails + num_sails) % num_sails;
  block->sail_position = 2.0 * (middle - sail) - 1.0;
}

Block make_block(const CellGrid& grid, int bond_block, double density) {
  const BondBlock& label = grid.bond.blocks[bond_block];
  Block block;
  block.kind = label.kind;
  block.truncated = label.truncated;
  block.spiral = label.spiral;
  block.density = density;
  block.fixed = label.kind == BlockKind::support;
  block.ring = grid.ring_of(grid.first_row(bond_block));
  if (block.fixed) return block;
  block.num_rings = grid.ring_of(grid.last_row(bond_block)) - block.ring + 1;
  set_sail(grid, slices_in_row(grid, bond_block, grid.first_row(bond_block)), &block);
  return block;
}

/// Drops the grid corners that no face uses because cells were merged.
void drop_unused_vertices(Assembly* assembly) {
  std::vector<int> new_id(assembly->vertices.size(), -1);
  for (int v : assembly->face_vertices) new_id[v] = 0;
  int count = 0;
  for (size_t v = 0; v < new_id.size(); ++v)
    if (new_id[v] == 0) {
      assembly->vertices[count] = assembly->vertices[v];
      new_id[v] = count++;
    }
  assembly->vertices.resize(count);
  for (int& v : assembly->face_vertices) v = new_id[v];
}

}  // namespace

Assembly cut_blocks(const Shell& shell, const CutOptions& options) {
  const SurfaceMap& surface = shell.surface;
  const std::vector<double>& cuts = shell.bond.cuts;
  const CellGrid grid = make_cell_grid(surface, shell.bond, shell.stage_rings);
  GridPoints points(grid, options.imperfections);
  Assembly assembly;
  if (surface.footing != Footing::masonry)
    add_base_support(surface, cuts, options.support_width, options.density, &assembly);
  points.make_shared(&assembly.vertices);
  for (int bond_block : grid.order) {
    Block block = make_block(grid, bond_block, options.density);
    const bool follows = !assembly.blocks.empty() && assembly.blocks.back().ring == block.ring;
    block.slot = follows ? assembly.blocks.back().slot + 1 : 0;
    assembly.blocks.push_back(block);
    points.start_block(bond_block);
    for (const CellRange& range : convex_ranges(grid, bond_block))
      add_part(grid, static_cast<int>(assembly.blocks.size()) - 1, range, &points, &assembly);
  }
  if (surface.footing == Footing::both_springings)
    add_far_support(surface, cuts, options.support_width, options.density, &assembly);
  drop_unused_vertices(&assembly);
  CUPOLA_ASSERT(std::ranges::all_of(assembly.vertices, [](const Vec3& v) { return v.allFinite(); }));
  assembly.num_rings = surface.num_rings();
  compute_mass_properties(&assembly);
  return assembly;
}

}  // namespace cupola
