#include "generators/stereotomy/cut_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "generators/stereotomy/support.hpp"

namespace cupola {
namespace {

/// A range of cells that becomes one convex part.
struct CellRange {
  int ring_start, ring_end;    // beds
  int slice_start, slice_end;  // cuts; slice_end may pass the seam of a closed surface
};

/// The grid with its bookkeeping: which column of vertices a cut is, who the neighbours are.
class Cutter {
 public:
  Cutter(const SurfaceMap& surface, const BondPattern& bond, const CutOptions& options)
      : surface_(surface), bond_(bond), options_(options), num_slices_(bond.num_slices()) {}

  Assembly cut();

 private:
  void make_vertices();
  void order_blocks();
  void add_block(int bond_block);
  void add_part(int block, const CellRange& cells);
  void set_sail(int slice_start, int slice_end, Block* block) const;
  void add_skin(const std::array<int, 4>& quad, FaceKind kind);
  void drop_unused_vertices();

  std::vector<CellRange> convex_ranges(int bond_block) const;
  std::vector<CellRange> ring_ranges(int bond_block, int ring) const;
  FaceKind bed_kind(const CellRange& cells, bool upper) const;
  FaceKind head_kind(const CellRange& cells, bool right) const;

  int wrap(int slice) const { return surface_.closed ? (slice + num_slices_) % num_slices_ : slice; }
  int owner(int ring, int slice) const { return bond_.at(ring, wrap(slice)); }
  bool built(int bond_block) const { return number_[bond_block] >= 0; }
  bool is_corner(int cut) const { return corner_[wrap(cut)]; }
  int vertex(int bed, int cut, Skin skin) const {
    return first_vertex_ + (bed * num_columns_ + wrap(cut)) * 2 + static_cast<int>(skin);
  }

  const SurfaceMap& surface_;
  const BondPattern& bond_;
  const CutOptions& options_;
  Assembly assembly_;
  int num_slices_;
  int num_columns_ = 0;
  int first_vertex_ = 0;
  std::vector<char> corner_;             // per cut
  std::vector<int> number_;              // bond block -> block id, -1: not built yet
  std::vector<std::vector<int>> cells_;  // bond block -> its cells, ring by ring
  std::vector<int> order_;               // bond blocks, ring by ring in slot order
};

void Cutter::make_vertices() {
  num_columns_ = surface_.closed ? num_slices_ : num_slices_ + 1;
  first_vertex_ = static_cast<int>(assembly_.vertices.size());
  for (int bed = 0; bed <= bond_.num_rings; ++bed)
    for (int column = 0; column < num_columns_; ++column)
      for (Skin skin : {Skin::intrados, Skin::extrados})
        assembly_.vertices.push_back(surface_.point(bed, bond_.cuts[column], skin));

  corner_.assign(num_slices_ + 1, 0);
  for (int cut = 0; cut <= num_slices_; ++cut)
    for (double corner : surface_.corners)
      if (std::abs(bond_.cuts[cut] - corner) < 1e-9 * surface_.extent) corner_[cut] = 1;
}

/// First slice of a block's run of cells in one ring, whichever side of the seam it lies on.
int run_start(const BondPattern& bond, const std::vector<int>& slices, bool closed) {
  const int num_slices = bond.num_slices();
  if (closed && static_cast<int>(slices.size()) < num_slices)
    for (size_t i = 1; i < slices.size(); ++i)
      if (slices[i] != slices[i - 1] + 1) return slices[i];  // the run crosses the seam and starts here
  return slices.front();
}

std::vector<CellRange> Cutter::ring_ranges(int bond_block, int ring) const {
  std::vector<int> slices;
  for (int cell : cells_[bond_block])
    if (cell / num_slices_ == ring) slices.push_back(cell % num_slices_);
  const int start = run_start(bond_, slices, surface_.closed);
  const int end = start + static_cast<int>(slices.size());
  std::vector<CellRange> ranges;
  for (int s = start; s < end; ++s) {
    if (surface_.flat_slices && s > start && !is_corner(s))
      ranges.back().slice_end = s + 1;
    else
      ranges.push_back({ring, ring + 1, s, s + 1});
  }
  return ranges;
}

std::vector<CellRange> Cutter::convex_ranges(int bond_block) const {
  const int first_ring = cells_[bond_block].front() / num_slices_;
  const int last_ring = cells_[bond_block].back() / num_slices_;
  std::vector<CellRange> ranges;
  for (int ring = first_ring; ring <= last_ring; ++ring)
    for (const CellRange& range : ring_ranges(bond_block, ring)) {
      const bool stacks = surface_.flat_rings && !ranges.empty() &&
                          ranges.back().slice_start == range.slice_start &&
                          ranges.back().slice_end == range.slice_end && ranges.back().ring_end == ring;
      if (stacks)
        ranges.back().ring_end = ring + 1;
      else
        ranges.push_back(range);
    }
  return ranges;
}

void Cutter::order_blocks() {
  const int num_blocks = static_cast<int>(bond_.blocks.size());
  cells_.resize(num_blocks);
  for (int cell = 0; cell < static_cast<int>(bond_.block_of.size()); ++cell)
    cells_[bond_.block_of[cell]].push_back(cell);

  std::vector<int> first_ring(num_blocks), start(num_blocks);
  for (int b = 0; b < num_blocks; ++b) {
    first_ring[b] = cells_[b].front() / num_slices_;
    start[b] = ring_ranges(b, first_ring[b]).front().slice_start;
    if (options_.stage_rings <= 0 || first_ring[b] < options_.stage_rings) order_.push_back(b);
  }
  std::ranges::sort(order_, [&](int a, int b) {
    return std::pair(first_ring[a], start[a]) < std::pair(first_ring[b], start[b]);
  });
  number_.assign(num_blocks, -1);
  for (size_t i = 0; i < order_.size(); ++i)
    number_[order_[i]] = static_cast<int>(assembly_.blocks.size() + i);
}

/// A bed is internal when its own block lies beyond, a joint when any built block (or the support) does.
FaceKind Cutter::bed_kind(const CellRange& cells, bool upper) const {
  const int beyond = upper ? cells.ring_end : cells.ring_start - 1;
  if (beyond < 0) return FaceKind::bed;
  if (beyond == bond_.num_rings)
    return surface_.footing == Footing::both_springings ? FaceKind::bed : FaceKind::top;
  const int self = owner(cells.ring_start, cells.slice_start);
  if (owner(beyond, cells.slice_start) == self) return FaceKind::internal;
  for (int s = cells.slice_start; s < cells.slice_end; ++s)
    if (built(owner(beyond, s))) return FaceKind::bed;
  return upper ? FaceKind::top : FaceKind::free;
}

FaceKind Cutter::head_kind(const CellRange& cells, bool right) const {
  const int beyond = right ? cells.slice_end : cells.slice_start - 1;
  if (!surface_.closed && (beyond < 0 || beyond == num_slices_)) return FaceKind::free;
  const int self = owner(cells.ring_start, cells.slice_start);
  if (owner(cells.ring_start, beyond) == self) return FaceKind::internal;
  for (int ring = cells.ring_start; ring < cells.ring_end; ++ring)
    if (built(owner(ring, beyond))) return FaceKind::head;
  return FaceKind::free;
}

/// Adds a skin face: the quad, or its two triangles on the diagonal that keeps the cell convex.
void Cutter::add_skin(const std::array<int, 4>& quad, FaceKind kind) {
  if (surface_.flat_skins) {
    assembly_.add_face(quad, kind);
    return;
  }
  const auto& p = assembly_.vertices;
  const Vec3 normal = (p[quad[1]] - p[quad[0]]).cross(p[quad[2]] - p[quad[0]]);
  const int first = normal.dot(p[quad[3]] - p[quad[0]]) <= 0.0 ? 0 : 1;
  const auto corner = [&](int i) { return quad[(first + i) % 4]; };
  assembly_.add_face(std::array{corner(0), corner(1), corner(2)}, kind);
  assembly_.add_face(std::array{corner(0), corner(2), corner(3)}, kind);
}

void Cutter::add_part(int block, const CellRange& cells) {
  Part part;
  part.block = block;
  part.ring = cells.ring_start;
  part.slice = wrap(cells.slice_start);
  part.face_start = assembly_.num_faces();
  assembly_.parts.push_back(part);

  // Corner names: lower / upper bed, left / right head, i(ntrados) / e(xtrados).
  const auto corner = [&](bool upper, bool right, Skin skin) {
    return vertex(upper ? cells.ring_end : cells.ring_start, right ? cells.slice_end : cells.slice_start,
                  skin);
  };
  const auto [i, e] = std::pair(Skin::intrados, Skin::extrados);
  const int lli = corner(false, false, i), lri = corner(false, true, i), lle = corner(false, false, e),
            lre = corner(false, true, e), uli = corner(true, false, i), uri = corner(true, true, i),
            ule = corner(true, false, e), ure = corner(true, true, e);
  // (outwards, along, up) is a right-handed frame on every surface; faces turn counter-clockwise from
  // outside.
  const std::array<std::array<int, 4>, 6> faces{{{lli, lri, lre, lle},
                                                 {uli, ule, ure, uri},
                                                 {lli, lle, ule, uli},
                                                 {lri, uri, ure, lre},
                                                 {lli, uli, uri, lri},
                                                 {lle, lre, ure, ule}}};
  assembly_.add_face(faces[0], bed_kind(cells, false));
  assembly_.add_face(faces[1], bed_kind(cells, true));
  assembly_.add_face(faces[2], head_kind(cells, false));
  assembly_.add_face(faces[3], head_kind(cells, true));
  add_skin(faces[4], FaceKind::intrados);
  add_skin(faces[5], FaceKind::extrados);
}

void Cutter::add_block(int bond_block) {
  const std::vector<int>& cells = cells_[bond_block];
  const BondBlock& label = bond_.blocks[bond_block];
  const int block_id = number_[bond_block];
  const std::vector<CellRange> ranges = convex_ranges(bond_block);

  Block block;
  block.kind = label.kind;
  block.truncated = label.truncated;
  block.spiral = label.spiral;
  block.density = options_.density;
  block.ring = cells.front() / num_slices_;
  block.num_rings = cells.back() / num_slices_ - block.ring + 1;
  block.slot = assembly_.blocks.back().ring == block.ring ? assembly_.blocks.back().slot + 1 : 0;
  assembly_.blocks.push_back(block);
  for (const CellRange& range : ranges) add_part(block_id, range);

  const std::vector<CellRange> lowest = ring_ranges(bond_block, block.ring);
  set_sail(lowest.front().slice_start, lowest.back().slice_end, &assembly_.blocks.back());
}

/// Sail of the block's middle, its place in it, and whether a corner of the surface lies inside the block.
void Cutter::set_sail(int slice_start, int slice_end, Block* block) const {
  if (surface_.corners.empty()) return;
  for (int cut = slice_start + 1; cut < slice_end; ++cut) block->rib = block->rib || is_corner(cut);
  const auto abscissa = [&](int cut) {
    return bond_.cuts[wrap(cut)] + (cut < 0 ? -surface_.extent : cut >= num_slices_ ? surface_.extent : 0.0);
  };
  const int num_sails = static_cast<int>(surface_.corners.size());
  const double sail_width = surface_.extent / num_sails;
  const double middle = 0.5 * (abscissa(slice_start) + abscissa(slice_end)) - surface_.corners.front();
  const double sail =
      std::floor(middle / sail_width + 1e-9);  // a middle on a corner belongs to the next sail
  block->sail = (static_cast<int>(sail) + num_sails) % num_sails;
  block->sail_position = 2.0 * (middle / sail_width - sail) - 1.0;
}

/// Merged parts leave grid corners that no face names.
void Cutter::drop_unused_vertices() {
  std::vector<int> new_id(assembly_.vertices.size(), -1);
  for (int v : assembly_.face_vertices) new_id[v] = 0;
  int count = 0;
  for (size_t v = 0; v < new_id.size(); ++v)
    if (new_id[v] == 0) {
      assembly_.vertices[count] = assembly_.vertices[v];
      new_id[v] = count++;
    }
  assembly_.vertices.resize(count);
  for (int& v : assembly_.face_vertices) v = new_id[v];
}

Assembly Cutter::cut() {
  add_base_support(surface_, bond_.cuts, options_.support_width, options_.density, &assembly_);
  make_vertices();
  order_blocks();
  for (int bond_block : order_) add_block(bond_block);
  drop_unused_vertices();
  assembly_.num_rings = bond_.num_rings;
  compute_mass_properties(&assembly_);
  return std::move(assembly_);
}

}  // namespace

Assembly cut_blocks(const SurfaceMap& surface, const BondPattern& bond, const CutOptions& options) {
  return Cutter(surface, bond, options).cut();
}

BondGrid bond_grid(const SurfaceMap& surface) {
  return {surface.num_rings, surface.closed, surface.extent, surface.corners};
}

}  // namespace cupola
