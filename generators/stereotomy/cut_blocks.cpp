#include "generators/stereotomy/cut_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/cell_grid.hpp"
#include "generators/stereotomy/cell_parts.hpp"
#include "generators/stereotomy/cut_bodies.hpp"
#include "generators/stereotomy/cut_planes.hpp"
#include "generators/stereotomy/grid_points.hpp"
#include "generators/stereotomy/groin_vault.hpp"
#include "generators/stereotomy/meetings.hpp"
#include "generators/stereotomy/part_supports.hpp"
#include "generators/stereotomy/support.hpp"

namespace cupola {
namespace {

int num_sails_of(const SurfaceMap& surface) {
  if (surface.sail_width == 0.0) return 1;
  return static_cast<int>(std::lround(2.0 * std::numbers::pi / surface.sail_width));
}

/// Sets the sail of the block's middle, the position in it, and whether a corner of the surface lies inside
/// the block.
void set_sail(const CellGrid& grid, int row, std::pair<int, int> slices, Block* block) {
  const SurfaceMap& surface = grid.surface;
  if (surface.sail_width == 0.0) return;
  const auto [start, end] = slices;
  for (int cut = start + 1; cut < end; ++cut) block->rib = block->rib || grid.is_corner(row, cut);
  const int num_sails = num_sails_of(surface);
  const double middle = (0.5 * (grid.abscissa(row, start) + grid.abscissa(row, end)) - surface.first_corner) /
                        surface.sail_width;
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
  block.member = label.member;
  block.density = density;
  block.fixed = label.kind == BlockKind::support;
  block.ring = grid.ring_of(grid.first_row(bond_block));
  if (block.fixed) return block;
  block.num_rings = grid.ring_of(grid.last_row(bond_block)) - block.ring + 1;
  const int row = grid.first_row(bond_block);
  set_sail(grid, row, slices_in_row(grid, bond_block, row), &block);
  return block;
}

/// Appends the stone that closes the eye of a closed surface: a prism over the whole last bed, whose facets
/// are its sides.
void add_key_stone(const CellGrid& grid, int member, double density, GridPoints* points, Assembly* assembly) {
  const int ring = grid.ring_of(grid.num_rows);
  Block block;
  block.density = density;
  block.ring = ring;
  block.member = member;
  assembly->blocks.push_back(block);
  assembly->parts.push_back({.block = static_cast<int>(assembly->blocks.size()) - 1,
                             .ring = ring,
                             .slice = 0,
                             .face_start = assembly->num_faces()});
  std::vector<int> inner, outer;
  const int last = grid.num_rows - 1;
  for (int cut = 0; cut < grid.slices_of(last); ++cut) {
    if (grid.surface.flat_slices && !grid.ends_facet(last, cut)) continue;
    inner.push_back(points->vertex(last, grid.num_rows, cut, 0, assembly));
    outer.push_back(points->vertex(last, grid.num_rows, cut, grid.num_wythes, assembly));
  }
  for (size_t i = 0; i < inner.size(); ++i) {
    const size_t j = (i + 1) % inner.size();
    assembly->add_face(std::array{inner[j], outer[j], outer[i], inner[i]}, FaceKind::bed);
  }
  assembly->add_face(outer, FaceKind::extrados);
  std::ranges::reverse(inner);
  assembly->add_face(inner, FaceKind::intrados);
}

/// Drops the grid corners that no face uses because cells were merged.
void drop_unused_vertices(Assembly* assembly) {
  const bool has_layers = !assembly->vertex_layers.empty();
  if (has_layers) {
    assembly->vertex_layers.resize(assembly->vertices.size(), -1);  // corners of supports
    assembly->vertex_depths.resize(assembly->vertices.size(), 0.0);
  }
  std::vector<int> new_id(assembly->vertices.size(), -1);
  for (int v : assembly->face_vertices) new_id[v] = 0;
  int count = 0;
  for (size_t v = 0; v < new_id.size(); ++v)
    if (new_id[v] == 0) {
      assembly->vertices[count] = assembly->vertices[v];
      if (has_layers) {
        assembly->vertex_layers[count] = assembly->vertex_layers[v];
        assembly->vertex_depths[count] = assembly->vertex_depths[v];
      }
      new_id[v] = count++;
    }
  assembly->vertices.resize(count);
  if (has_layers) {
    assembly->vertex_layers.resize(count);
    assembly->vertex_depths.resize(count);
  }
  for (int& v : assembly->face_vertices) v = new_id[v];
}

/// Moves the vertices from `first` on. A reflection reverses the faces from `first_face` on.
void place(const Storey& shell, size_t first, int first_face, Assembly* assembly) {
  if (shell.placement.matrix() == Eigen::Matrix4d::Identity()) return;  // to the bit
  for (size_t v = first; v < assembly->vertices.size(); ++v)
    assembly->vertices[v] = shell.placement * assembly->vertices[v];
  if (!shell.is_reflected()) return;
  for (int f = first_face; f < assembly->num_faces(); ++f)
    std::reverse(assembly->face_vertices.begin() + assembly->face_vertex_start[f],
                 assembly->face_vertices.begin() + assembly->face_vertex_start[f + 1]);
}

/// Numbers the sails of a reflected member the other way round, as its azimuth.
void reflect_sails(int num_sails, const MemberStart& start, Assembly* assembly) {
  for (size_t b = start.block; b < assembly->blocks.size(); ++b) {
    Block& block = assembly->blocks[b];
    if (block.fixed) continue;
    block.sail = num_sails - 1 - block.sail;
    block.sail_position = -block.sail_position;
  }
}

/// The bodies that mitres of other storeys take from a storey: what lies before their planes.
std::vector<CutBody> bodies_of_mitres(const Storey& storey, std::span<const Storey> storeys) {
  std::vector<CutBody> bodies;
  for (const Storey& other : storeys)
    for (size_t i = 0; i < other.cuts.size(); ++i) {
      const Cut& cut = other.cuts[i];
      if (cut.as != Cut::As::mitre || cut.member != storey.name || &other == &storey) continue;
      const Vec3 lost = cut.normal.normalized();
      bodies.push_back({cut,
                        {moved({{lost, lost.dot(cut.point)}}, storey.placement.inverse() * other.placement)},
                        fmt::format("{}.cuts[{}].member = {}", other.key, i, cut.member)});
    }
  return bodies;
}

/// The bodies of the cuts of a storey, in its coordinates.
std::vector<CutBody> bodies_of(const Storey& storey, std::span<const Storey> storeys) {
  std::vector<CutBody> bodies;
  for (size_t i = 0; i < storey.cuts.size(); ++i) {
    const Cut& cut = storey.cuts[i];
    const std::string key = fmt::format("{}.cuts[{}]", storey.key, i);
    if (cut.as == Cut::As::mitre &&
        (cut.member == storey.name || std::ranges::find(storeys, cut.member, &Storey::name) == storeys.end()))
      throw InputError(fmt::format("{}.member = {}: must be another member", key, cut.member));
    if (cut.kind != Cut::Kind::under && cut.kind != Cut::Kind::over) {
      bodies.push_back({cut, {body_of(cut)}, key});
      continue;
    }
    const auto other = std::ranges::find(storeys, cut.member, &Storey::name);
    const bool is_over = cut.kind == Cut::Kind::over;
    if (other == storeys.end() || &*other == &storey || other->surface.closed ||
        (other->surface.webs > 0) != is_over)
      throw InputError(fmt::format("{}.member = {}: must be another member, over a plan of type {}", key,
                                   cut.member, is_over ? "groin" : "line"));
    bodies.push_back({cut, {}, key});
    if (is_over)
      bodies.back().bodies = bodies_over(*other);
    else
      bodies.back().bodies = {body_under(*other, cut.face, key)};
    for (std::vector<Plane>& body : bodies.back().bodies)
      body = moved(std::move(body), storey.placement.inverse() * other->placement);
  }
  std::ranges::move(bodies_of_mitres(storey, storeys), std::back_inserter(bodies));
  for (const Plane& limit : storey.limits)
    bodies.push_back({{}, {{{-limit.normal, -limit.offset}}}, storey.key + ".beside", true});
  return bodies;
}

/// Appends the blocks of a storey, with the supports between which it stands.
void add_storey(const Storey& shell, std::span<const Storey> storeys, const CutOptions& options,
                Assembly* assembly) {
  const SurfaceMap& surface = shell.surface;
  const size_t first_vertex = assembly->vertices.size();
  const MemberStart start{assembly->blocks.size(), assembly->parts.size()};
  const int first_face = assembly->num_faces();
  const CellGrid grid = make_cell_grid(surface, shell.bond, shell.stage_rings);
  GridPoints points(grid, options.imperfections, shell.placement);
  const std::vector<double> cuts = points.cuts_at_supports();
  const bool stands = surface.webs == 0;  // on supports of its own beds, not of the finished groin vault
  if (stands && surface.first_bed_held && !surface.first_row_held)
    add_base_support(surface, cuts, options.support_width, options.base_blocks, options.density, assembly);
  const int first_member = static_cast<int>(assembly->members.size());
  std::ranges::copy(shell.members, std::back_inserter(assembly->members));
  std::ranges::copy(shell.originals.empty() ? shell.members : shell.originals,
                    std::back_inserter(assembly->member_originals));
  points.make_shared(first_member, assembly);
  const size_t first_part = assembly->parts.size();
  for (int bond_block : grid.order) {
    Block block = make_block(grid, bond_block, options.density);
    block.member += first_member;
    const bool follows = !assembly->blocks.empty() && assembly->blocks.back().ring == block.ring;
    block.slot = follows ? assembly->blocks.back().slot + 1 : 0;
    assembly->blocks.push_back(block);
    points.start_block(bond_block);
    for (const CellRange& range : convex_ranges(grid, bond_block)) add_parts(grid, range, &points, assembly);
  }
  if (surface.key_stone && shell.stage_rings == 0)
    add_key_stone(grid, first_member, options.density, &points, assembly);
  refuse_inverted_parts(*assembly, first_part, shell.key + ".surface");
  if (stands && surface.last_bed_held)
    add_far_support(surface, cuts, options.support_width, options.density, assembly);
  if (surface.webs > 0) cross_webs(shell, start, options, assembly);
  if (shell.affine)
    for (size_t v = first_vertex; v < assembly->vertices.size(); ++v)
      assembly->vertices[v] = shell.affine->image(assembly->vertices[v]);
  const double gap = options.imperfections ? options.imperfections->gap : 0.0;
  const auto bed_under = [&](const Part& part, int ring) {
    const int row = (part.ring - grid.ring_of(0)) * surface.rows_per_ring;
    return points.bed_plane((ring - grid.ring_of(0)) * surface.rows_per_ring, row, part.slice);
  };
  cut_bodies(bodies_of(shell, storeys), start, options.support_width, options.density, gap,
             surface.flat_rings && surface.webs == 0 ? bed_under : BedUnder(), assembly);
  for (size_t b = start.block; b < assembly->blocks.size(); ++b)
    if (assembly->blocks[b].fixed) assembly->blocks[b].member = first_member;
  place(shell, first_vertex, first_face, assembly);
  if (shell.is_reflected() && surface.sail_width > 0.0) reflect_sails(num_sails_of(surface), start, assembly);
  assembly->num_rings = surface.rings_below + shell.num_rings();
  const Vec3 x_axis = shell.placement.linear().col(0);
  assembly->sheets.push_back({shell.name, surface.rings_below, shell.num_rings(), surface.closed,
                              surface.thrust_lines, num_sails_of(surface), shell.stands_on_previous,
                              shell.placement.translation(), std::atan2(x_axis.y(), x_axis.x())});
}

}  // namespace

Assembly cut_blocks(std::span<const Storey> storeys, const CutOptions& options) {
  Assembly assembly;
  std::vector<MemberStart> starts;
  for (const Storey& storey : storeys) {
    starts.push_back({assembly.blocks.size(), assembly.parts.size()});
    add_storey(storey, storeys, options, &assembly);
  }
  starts.push_back({assembly.blocks.size(), assembly.parts.size()});
  part_supports(starts, options.imperfections ? options.imperfections->gap : 0.0, &assembly);
  check_meetings(storeys, starts, &assembly);
  drop_unused_vertices(&assembly);
  CUPOLA_ASSERT(std::ranges::all_of(assembly.vertices, [](const Vec3& v) { return v.allFinite(); }));
  compute_mass_properties(&assembly);
  return assembly;
}

}  // namespace cupola
