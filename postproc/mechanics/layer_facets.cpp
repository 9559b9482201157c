#include "postproc/mechanics/layer_facets.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "postproc/mechanics/cut_facet.hpp"

namespace cupola {
namespace {

/// True if all corners of a face belong to the ring below, too: the face lies on the bed, and is no cut
/// through a cell.
bool is_on_bed_below(const Assembly& assembly, const Part& part, int f) {
  const auto first = std::ranges::lower_bound(assembly.parts, part.block, {}, &Part::block);
  const auto last = std::ranges::upper_bound(assembly.parts, part.block, {}, &Part::block);
  const auto in_ring_below = [&](int v) {
    return std::any_of(first, last, [&](const Part& below) {
      if (below.ring != part.ring - 1) return false;
      for (int g = below.face_start; g < below.face_start + below.num_faces; ++g)
        if (std::ranges::find(assembly.face(g), v) != assembly.face(g).end()) return true;
      return false;
    });
  };
  return std::ranges::all_of(assembly.face(f), in_ring_below);
}

/// The facet of a cell with two corners on each of its layers; none of a stone that was cut.
std::optional<BedFacet> whole_facet(const Assembly& assembly, int block, const std::vector<int>& corners) {
  const auto depth = [&](int v) { return assembly.vertex_depths[v]; };
  const auto [low, high] = std::ranges::minmax(corners, {}, depth);
  std::vector<Vec3> inner, outer;
  for (const int v : corners) (depth(v) == depth(low) ? inner : outer).push_back(assembly.vertices[v]);
  if (inner.size() != 2 || outer.size() != 2) return std::nullopt;
  const double parallel = (inner[0] - outer[0]).norm() + (inner[1] - outer[1]).norm();
  const double crossed = (inner[0] - outer[1]).norm() + (inner[1] - outer[0]).norm();
  if (crossed < parallel) std::swap(outer[0], outer[1]);
  return BedFacet{block, inner[0], inner[1], outer[0], outer[1], false, depth(low), depth(high)};
}

/// Finds the innermost wythe of each drum or shell: it begins at the layer of depth 0 and ends at the next
/// one of depth 1. Numbers of bonders between them are their own.
void set_innermost(const Assembly& assembly, std::vector<int>* innermost) {
  const int num_wythes = static_cast<int>(innermost->size());
  std::vector<bool> begins(num_wythes + 1, false), ends(num_wythes + 1, false);
  for (size_t v = 0; v < assembly.vertices.size(); ++v) {
    const int layer = assembly.vertex_layers[v];
    if (layer < 0) continue;
    begins[layer] = begins[layer] || assembly.vertex_depths[v] == 0.0;
    ends[layer] = ends[layer] || assembly.vertex_depths[v] == 1.0;
  }
  int first = -1;
  for (int wythe = 0; wythe < num_wythes; ++wythe) {
    if (ends[wythe]) first = -1;
    if (begins[wythe]) first = wythe;
    (*innermost)[wythe] = first >= 0 ? first : wythe;
  }
}

}  // namespace

void LayerFacets::add(const Part& part, int f, int bed) {
  const bool internal = assembly_.face_kinds[f] == FaceKind::internal;
  if (internal && !is_on_bed_below(assembly_, part, f)) return;
  Cell& cell = cells_[{bed, part.block, part.slice, part.wythe}];
  cell.internal = internal;
  const std::vector<Vec3> corners = face_points(assembly_, f);
  cell.normal += polygon_area(corners) * polygon_plane(corners).normal;
  for (const int v : assembly_.face(f))
    if (std::ranges::find(cell.corners, v) == cell.corners.end()) cell.corners.push_back(v);
}

void LayerFacets::add_to(Shell* shell) const {
  std::set<std::pair<int, int>> whole;  // (bed, block)
  for (const auto& [key, cell] : cells_) {
    const auto [bed, block, slice, wythe] = key;
    std::optional<BedFacet> facet = whole_facet(assembly_, block, cell.corners);
    if (!facet) continue;
    facet->internal = cell.internal;
    shell->beds[bed].push_back(*facet);
    whole.emplace(bed, block);
  }
  for (const auto& [key, cell] : cells_) {
    const auto [bed, block, slice, wythe] = key;
    if (whole.contains({bed, block})) continue;
    std::vector<Vec3> corners;
    std::vector<double> depths;
    for (const int v : cell.corners) {
      corners.push_back(assembly_.vertices[v]);
      depths.push_back(assembly_.vertex_depths[v]);
    }
    std::optional<BedFacet> facet =
        facet_around(block, corners, cell.normal.normalized(), growth(corners, depths));
    if (!facet) continue;
    facet->internal = cell.internal;
    facet->from = std::ranges::min(depths);
    facet->to = std::ranges::max(depths);
    shell->beds[bed].push_back(*facet);
  }
}

void set_wythes(const Assembly& assembly, Shell* shell) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  shell->wythes.resize(assembly.blocks.size());
  for (const int layer : assembly.vertex_layers) shell->num_wythes = std::max(shell->num_wythes, layer);
  shell->layers.assign(shell->beds.size(), std::vector<double>(shell->num_wythes + 1, kUnknown));
  shell->innermost.assign(shell->num_wythes, 0);
  if (assembly.vertex_layers.empty()) {
    shell->layers.assign(shell->beds.size(), {0.0, 1.0});
    return;
  }
  set_innermost(assembly, &shell->innermost);
  for (size_t b = 0; b < shell->wythes.size(); ++b)
    shell->wythes[b] =
        assembly.blocks[b].fixed ? WytheRange{0, shell->num_wythes} : WytheRange{shell->num_wythes, 0};
  for (const Part& part : assembly.parts) {
    if (assembly.blocks[part.block].fixed) continue;
    WytheRange& range = shell->wythes[part.block];
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f)) {
        const int layer = assembly.vertex_layers[v];
        if (layer < 0) continue;  // where a cut ends
        range.from = std::min(range.from, layer);
        range.to = std::max(range.to, layer);
      }
  }
  for (size_t b = 0; b < shell->wythes.size(); ++b)
    if (WytheRange& range = shell->wythes[b];
        range.from >= range.to) {  // cut away from both layers of a wythe
      const int wythe = std::min(assembly.blocks[b].member, shell->num_wythes - 1);
      range = {wythe, wythe + 1};
    }
}

}  // namespace cupola
