#include "postproc/mechanics/shell.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "postproc/mechanics/bed_sides.hpp"
#include "postproc/mechanics/cut_facet.hpp"
#include "postproc/mechanics/layer_facets.hpp"
#include "postproc/mechanics/skin_facet.hpp"

namespace cupola {
namespace {

/// Number of rings that the blocks occupy; 0 for imported blocks without rings.
int rings_present(const Assembly& assembly) {
  int rings = 0;
  if (assembly.num_rings == 0) return 0;
  for (const Part& part : assembly.parts) rings = std::max(rings, part.ring + 1);
  return rings;
}

/// The value in the middle, of an even number the upper one: a width that a block has, as no mean is.
double middle_value(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Middle width in azimuth of the standard blocks of the courses [first, end), of all where none is, rad.
double standard_width(const Assembly& assembly, const Shell& shell, int first, int end) {
  const Sheet axis = assembly.axis_of(first);
  std::map<int, double> widths;  // rad, by block: range of azimuths on its own bed
  for (int bed = first; bed < end; ++bed)
    for (const BedFacet& facet : shell.beds[bed])
      if (!facet.internal)
        widths[facet.block] +=
            std::abs(wrapped(azimuth(axis.own(facet.intrados_b)) - azimuth(axis.own(facet.intrados_a))));
  std::vector<double> all, standard;
  for (const auto& [block, width] : widths) {
    all.push_back(width);
    if (assembly.blocks[block].kind != BlockKind::herringbone) standard.push_back(width);
  }
  return middle_value(standard.empty() ? std::move(all) : std::move(standard));
}

/// The blocks on a bed; `axis`: of its stack.
std::vector<BlockBed> blocks_on(const std::vector<BedFacet>& bed, const Sheet& axis) {
  std::map<int, BlockBed> by_number;
  for (size_t i = 0; i < bed.size(); ++i) {
    const BedFacet& facet = bed[i];
    const auto [entry, is_new] = by_number.try_emplace(facet.block);
    BlockBed& block = entry->second;
    if (is_new) block.from = block.to = azimuth(axis.own(facet.intrados_a));
    for (const Vec3& corner : {facet.intrados_a, facet.intrados_b}) {
      const double angle = block.from + wrapped(azimuth(axis.own(corner)) - block.from);
      block.from = std::min(block.from, angle);
      block.to = std::max(block.to, angle);
    }
    block.facets.push_back(static_cast<int>(i));
  }
  std::vector<BlockBed> blocks;
  blocks.reserve(by_number.size());
  for (auto& [number, block] : by_number) {
    block.block = number;
    Vec3 normal = Vec3::Zero(), mean = Vec3::Zero();
    for (const int i : block.facets) {
      const BedFacet& f = bed[i];
      normal += (f.intrados_b - f.extrados_a).cross(f.extrados_b - f.intrados_a);
      mean += 0.25 * (f.intrados_a + f.intrados_b + f.extrados_a + f.extrados_b);
    }
    normal.normalize();
    block.plane = {normal, normal.dot(mean) / static_cast<double>(block.facets.size())};
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace

double model_size(const Assembly& assembly) {
  Eigen::AlignedBox3d box;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) box.extend(block.centroid);
  return std::max(box.diagonal().norm(), std::cbrt(assembly.blocks.front().volume));
}

double on_plane_tolerance(const Assembly& assembly) {
  return 1e-9 * model_size(assembly);
}

double block_size(const Assembly& assembly) {
  double volume = 0.0;
  int free = 0;
  for (const Block& block : assembly.blocks) {
    volume += block.fixed ? 0.0 : block.volume;
    free += block.fixed ? 0 : 1;
  }
  return free > 0 ? std::cbrt(volume / free) : 0.0;
}

double azimuth(const Vec3& point) {
  return std::atan2(point.y(), point.x());
}

double azimuth(const Assembly& assembly, int block_a, int block_b, const Vec3& point) {
  const int ring = std::max(assembly.blocks[block_a].ring, assembly.blocks[block_b].ring);
  return azimuth(assembly.axis_of(ring).own(point));
}

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

int Shell::bed_above(int ring) const {
  const auto stack = std::ranges::find(ends, ring + 1);
  return stack == ends.end() ? ring + 1 : num_rings() + static_cast<int>(stack - ends.begin());
}

const Vec3& Shell::direction(int ring) const {
  if (progress.empty()) return up;
  return progress[closes(ring) ? number_of(ring) - 1 : std::max(ring, 0)];
}

double Shell::wythes_inside(int block) const {
  const WytheRange& range = wythes[block];
  return 0.5 * (range.from + range.to - 1) - innermost[range.from];
}

bool Shell::is_alone(int wythe) const {
  return innermost[wythe] == wythe && (wythe + 1 == num_wythes || innermost[wythe + 1] == wythe + 1);
}

int Shell::most_wythes() const {
  int most = 1;
  const int known = static_cast<int>(innermost.size());  // none in models without courses
  for (int wythe = 0; wythe < known; ++wythe) most = std::max(most, wythe - innermost[wythe] + 1);
  return most;
}

Shell shell_of(const Assembly& assembly, const Vec3& up) {
  Shell shell;
  shell.up = up;
  const int num_rings = rings_present(assembly);
  if (num_rings == 0) return shell;
  const BedSides sides(assembly, num_rings);
  shell.progress = sides.progress();
  for (int ring = 0; ring < num_rings; ring = shell.ends.back())
    shell.ends.push_back(std::min(assembly.stack_of(ring).second, num_rings));
  shell.beds.resize(static_cast<size_t>(num_rings) + shell.ends.size());
  set_wythes(assembly, &shell);
  const bool has_layers = !assembly.vertex_layers.empty();
  LayerFacets facets(assembly);
  std::vector<std::vector<BedFace>> faces(shell.beds.size());
  const auto add = [&](const Part& part, int f, int bed) {
    if (has_layers) return facets.add(part, f, bed);
    faces[bed].push_back({&part, f});
    add_skin_facet(assembly, part, f, &shell.beds[bed]);
  };
  for (const Part& part : assembly.parts) {
    if (part.ring < 0) continue;
    const Block& block = assembly.blocks[part.block];
    const int above = shell.bed_above(part.ring);
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const FaceKind kind = assembly.face_kinds[f];
      const bool joint = kind == FaceKind::bed || kind == FaceKind::top;
      const bool inside = kind == FaceKind::internal && block.num_rings > 1 && part.ring > block.ring;
      if (!joint && !inside) continue;
      const int side = sides.side_of(part, f);
      if (side < 0) add(part, f, part.ring);
      if (side > 0 && joint && shell.closes(above)) add(part, f, above);
      if (has_layers && joint && side != 0)
        for (const int v : assembly.face(f)) {
          if (assembly.vertex_layers[v] < 0) continue;  // of a cut
          double& share = shell.layers[side > 0 ? above : part.ring][assembly.vertex_layers[v]];
          if (side < 0 || std::isnan(share))
            share = assembly.vertex_depths[v];  // a drum may be as wide below
        }
    }
  }
  facets.add_to(&shell);
  for (int bed = 0; bed < static_cast<int>(shell.beds.size()); ++bed) {
    add_cut_facets(assembly, faces[bed], &shell.beds[bed]);
    const int ring = shell.closes(bed) ? shell.number_of(bed) - 1 : bed;
    shell.blocks.push_back(blocks_on(shell.beds[bed], assembly.axis_of(assembly.stack_of(ring).first)));
  }
  for (const int end : shell.ends) {
    const int first = static_cast<int>(shell.block_width_rad.size());
    shell.block_width_rad.resize(static_cast<size_t>(end), standard_width(assembly, shell, first, end));
  }
  return shell;
}

}  // namespace cupola
