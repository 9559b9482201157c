#include "generators/stereotomy/support.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "generators/surface/profile.hpp"

namespace cupola {
namespace {

int start_support_block(double density, Assembly* assembly) {
  Block block;
  block.kind = BlockKind::support;
  block.fixed = true;
  block.ring = -1;
  block.density = density;
  assembly->blocks.push_back(block);
  return static_cast<int>(assembly->blocks.size()) - 1;
}

void start_part(int block, int slice, Assembly* assembly) {
  Part part;
  part.block = block;
  part.ring = -1;
  part.slice = slice;
  part.face_start = assembly->num_faces();
  assembly->parts.push_back(part);
}

/// Adds a hexahedron. `top` is counter-clockwise seen from outside, `bottom` lies below it in the same order,
/// and `sides[i]` is the kind of the face at the edge top[i] - top[i + 1].
void add_hexahedron(const std::array<int, 4>& top, const std::array<int, 4>& bottom,
                    const std::array<FaceKind, 4>& sides, Assembly* assembly) {
  assembly->add_face(top, FaceKind::bed);
  assembly->add_face(std::array{bottom[3], bottom[2], bottom[1], bottom[0]}, FaceKind::free);
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    assembly->add_face(std::array{top[j], top[i], bottom[i], bottom[j]}, sides[i]);
  }
}

int add_vertex(const Vec3& point, Assembly* assembly) {
  assembly->vertices.push_back(point);
  return static_cast<int>(assembly->vertices.size()) - 1;
}

/// The cuts of a ring of several blocks: those given and the boundaries of the blocks, of which the first cut
/// is one.
std::vector<double> cuts_of_blocks(const SurfaceMap& surface, const std::vector<double>& cuts,
                                   int num_blocks) {
  const double extent = surface.extent, rounding = 1e-9 * extent;  // nearer cuts coincide
  const double start = surface.first_corner - 0.5 * extent / num_blocks;
  std::vector<double> all;
  for (int b = 0; b <= num_blocks; ++b) all.push_back(start + extent * b / num_blocks);
  for (size_t s = 0; s + 1 < cuts.size(); ++s) {
    const double cut = cuts[s] - extent * std::floor((cuts[s] - start) / extent);
    const double blocks = (cut - start) / extent * num_blocks;
    if (std::abs(blocks - std::round(blocks)) * extent / num_blocks > rounding) all.push_back(cut);
  }
  std::ranges::sort(all);
  return all;
}

/// The line of the first bed at a cut, on which the ring lies, too.
struct BedLine {
  Vec3 base, back;                                              // m, on the intrados and on the extrados
  Vec3 along = (back - base) / (back - base).head<2>().norm();  // of length 1 seen from above
};

/// The line at a cut of the ring. Between two cuts of the shell, the edges of a round bed are chords.
BedLine line_at(const SurfaceMap& surface, const std::vector<double>& shell_cuts, double cut) {
  const auto line = [&](double at) { return BedLine{surface.intrados(0, at), surface.extrados(0, at)}; };
  if (surface.flat_slices || std::ranges::binary_search(shell_cuts, cut)) return line(cut);
  const double azimuth = cut - surface.extent * std::floor((cut - shell_cuts.front()) / surface.extent);
  const auto above = std::upper_bound(shell_cuts.begin() + 1, shell_cuts.end() - 1, azimuth);
  const double before = std::sin(azimuth - *(above - 1)), behind = std::sin(*above - azimuth);
  const double share = before / (before + behind);  // of a chord between equal distances from the axis
  const BedLine a = line(*(above - 1)), b = line(*above);
  return {a.base + share * (b.base - a.base), a.back + share * (b.back - a.back)};
}

/// m, at most `width`, by which the ring extends inwards: half-way to where the lines of two neighbours meet.
double inner_width(const std::vector<BedLine>& lines, double width) {
  for (size_t s = 0; s + 1 < lines.size(); ++s) {
    const Vec2 a = lines[s].along.head<2>(), b = lines[s + 1].along.head<2>(),
               chord = (lines[s + 1].base - lines[s].base).head<2>();
    const double sine = cross(a, b);
    if (sine > 0.0) width = std::min(width, 0.5 * std::min(cross(a, chord), cross(b, chord)) / sine);
  }
  return width;
}

void add_ring(const SurfaceMap& surface, const std::vector<double>& shell_cuts, double width, int num_blocks,
              double density, Assembly* assembly) {
  const std::vector<double> cuts =
      num_blocks == 1 ? shell_cuts : cuts_of_blocks(surface, shell_cuts, num_blocks);
  const int num_slices = static_cast<int>(cuts.size()) - 1;
  std::vector<BedLine> lines;
  for (const double cut : cuts) lines.push_back(line_at(surface, shell_cuts, cut));
  const double inside = inner_width(lines, width);
  std::vector<std::pair<Vec3, Vec3>> tops;
  double floor = std::numeric_limits<double>::infinity();
  for (const auto& [base, back, along] : lines) {
    tops.emplace_back(base - inside * along, back + width * along);
    floor = std::min({floor, tops.back().first.z() - width, tops.back().second.z() - width});
  }
  std::vector<std::array<int, 4>> corners;  // per cut: inner top, outer top, outer bottom, inner bottom
  for (int s = 0; s < num_slices; ++s) {
    const auto& [inner, outer] = tops[s];
    corners.push_back({add_vertex(inner, assembly), add_vertex(outer, assembly),
                       add_vertex({outer.x(), outer.y(), floor}, assembly),
                       add_vertex({inner.x(), inner.y(), floor}, assembly)});
  }
  const auto block_of = [&](int slice) {
    const double middle = 0.5 * (cuts[slice] + cuts[slice + 1]) - cuts.front();
    return num_blocks == 1 ? 0 : static_cast<int>(middle / surface.extent * num_blocks);
  };
  int block = -1;
  for (int s = 0; s < num_slices; ++s) {
    if (s == 0 || block_of(s) != block_of(s - 1)) block = start_support_block(density, assembly);
    const auto& a = corners[s];
    const auto& b = corners[(s + 1) % num_slices];
    const auto side = [&](int neighbour) {
      return block_of((neighbour + num_slices) % num_slices) == block_of(s) ? FaceKind::internal
                                                                            : FaceKind::free;
    };
    start_part(block, s, assembly);
    add_hexahedron({a[0], a[1], b[1], b[0]}, {a[3], a[2], b[2], b[3]},
                   {side(s - 1), FaceKind::free, side(s + 1), FaceKind::free}, assembly);
  }
}

/// Adds a box behind bed `bed`, on the side away from the neighbouring bed `inside`.
void add_plate(const SurfaceMap& surface, const std::vector<double>& cuts, int bed, int inside, double width,
               double density, Assembly* assembly) {
  const Vec3 a = surface.intrados(bed, cuts.front());
  const Vec3 b = surface.intrados(bed, cuts.back());
  const Vec3 c = surface.extrados(bed, cuts.back());
  const Vec3 d = surface.extrados(bed, cuts.front());
  const Vec3 along = (b - a).normalized();
  const Vec3 across = (d - a).normalized();
  Vec3 up = across.cross(along).normalized();
  const bool flipped = up.dot(surface.intrados(inside, cuts.front()) - a) < 0.0;
  if (flipped) up = -up;
  // Two supports that face each other leave at least half of the clear span between them.
  const int other_end = bed == 0 ? surface.num_rows : 0;
  const double clear = (surface.intrados(other_end, cuts.front()) - a).norm();
  const double inner = surface.last_bed_held ? std::min(width, clear / 4.0) : width;

  std::array<Vec3, 4> corners{a - width * along - inner * across, d + width * (across - along),
                              c + width * (along + across), b + width * along - inner * across};
  if (flipped) std::swap(corners[1], corners[3]);  // counter-clockwise seen from the shell
  add_box_support(corners, -width * up, density, assembly);
}

}  // namespace

void add_box_support(const std::array<Vec3, 4>& top, const Vec3& depth, double density, Assembly* assembly) {
  start_support_block(density, assembly);
  std::array<int, 4> top_ids{}, bottom_ids{};
  for (int i = 0; i < 4; ++i) top_ids[i] = add_vertex(top[i], assembly);
  for (int i = 0; i < 4; ++i) bottom_ids[i] = add_vertex(top[i] + depth, assembly);
  start_part(static_cast<int>(assembly->blocks.size()) - 1, 0, assembly);
  constexpr FaceKind kFree = FaceKind::free;
  add_hexahedron(top_ids, bottom_ids, {kFree, kFree, kFree, kFree}, assembly);
}

void add_base_support(const SurfaceMap& surface, const std::vector<double>& cuts, double width,
                      int num_blocks, double density, Assembly* assembly) {
  if (surface.closed) {
    add_ring(surface, cuts, width, num_blocks, density, assembly);
    return;
  }
  add_plate(surface, cuts, 0, 1, width, density, assembly);
}

void add_far_support(const SurfaceMap& surface, const std::vector<double>& cuts, double width, double density,
                     Assembly* assembly) {
  add_plate(surface, cuts, surface.num_rows, surface.num_rows - 1, width, density, assembly);
}

}  // namespace cupola
