#include "generators/stereotomy/shell.hpp"

#include <fmt/format.h>

#include "generators/bond/long_blocks.hpp"
#include "generators/bond/make_bond.hpp"
#include "generators/bond/wythe_bond.hpp"
#include "generators/stereotomy/drum.hpp"
#include "generators/surface/make_surface.hpp"
#include "generators/surface/window.hpp"

namespace cupola {
namespace {

/// Adds the supports of a window: a row below the first, and with held ends a slice beyond each end.
BondPattern with_supports(const BondPattern& bond, double held_end) {
  const int beyond = held_end > 0.0 ? 1 : 0;  // slices
  BondPattern out;
  out.num_rings = bond.num_rings + 1;
  out.num_wythes = bond.num_wythes;
  if (beyond > 0) out.cuts.push_back(-held_end);
  out.cuts.insert(out.cuts.end(), bond.cuts.begin(), bond.cuts.end());
  if (beyond > 0) out.cuts.push_back(bond.cuts.back() + held_end);
  out.blocks = bond.blocks;
  const int base = static_cast<int>(out.blocks.size()), last = out.num_slices() - 1;
  out.blocks.resize(out.blocks.size() + 1 + 2 * static_cast<size_t>(beyond), {BlockKind::support, false, -1});
  for (int row = 0; row < out.num_rings; ++row)
    for (int slice = 0; slice <= last; ++slice)
      for (int wythe = 0; wythe < out.num_wythes; ++wythe) {
        const bool at_end = beyond > 0 && (slice == 0 || slice == last);
        out.block_of.push_back(at_end     ? base + (slice == 0 ? 1 : 2)
                               : row == 0 ? base
                                          : bond.at(row - 1, slice - beyond, wythe));
      }
  return out;
}

/// Maps all points of a surface. Heights change with them, depths do not.
void apply(const Affine& affine, SurfaceMap* surface) {
  surface->at = [affine, at = surface->at](double bed, double abscissa, double depth) -> Vec3 {
    Vec3 p = affine.scale.cwiseProduct(at(bed, abscissa, depth));
    p.z() += affine.rake * p.y();
    return p;
  };
  if (surface->shell_volume) *surface->shell_volume *= affine.scale.prod();
}

/// m above the datum of the surface, of the middle of each course.
std::vector<double> course_heights(const SurfaceMap& surface) {
  std::vector<double> heights;
  for (int ring = 0; ring < surface.num_rings(); ++ring)
    heights.push_back(surface.height((ring - surface.first_ring() + 0.5) * surface.rows_per_ring));
  return heights;
}

}  // namespace

std::vector<Thickness> thicknesses(const std::vector<Wythe>& wythes) {
  std::vector<Thickness> out;
  for (const Wythe& wythe : wythes) out.push_back(wythe.thickness);
  return out;
}

BondPattern lay_masonry(const Masonry& masonry, const SurfaceMap& surface, const BondGrid& grid) {
  return masonry.wythes.empty() ? make_bond(masonry.bond, grid)
                                : make_wythe_bond(masonry, grid, course_heights(surface));
}

Storey make_shell(const Geometry& geometry) {
  const Bond& bond_of_courses = *finest_bond(geometry);
  const int courses = rings_of(bond_of_courses);
  const int stage = geometry.stage ? geometry.stage->rings * refinement_of(bond_of_courses) : 0;
  SurfaceMap surface = geometry.window
                           ? window_surface(geometry.surface, thicknesses(geometry.wythes), *geometry.window,
                                            courses, stage > 0 ? stage : courses, geometry.support_width)
                           : make_surface(geometry.surface, courses, thicknesses(geometry.wythes));
  if (geometry.affine) apply(*geometry.affine, &surface);
  const BondGrid grid{surface.num_rings(),         surface.closed, surface.extent, surface.corners,
                      geometry.window.has_value(), stage};
  BondPattern bond = lay_masonry(geometry, surface, grid);
  const int refinement = refinement_of(bond_of_courses);
  for (size_t c = 0; c < geometry.chains.size(); ++c)
    if (const Chain& chain = geometry.chains[c]; chain.long_blocks > 0)
      lay_long_blocks(grid, chain.course * refinement, (chain.course + 1) * refinement - 1, chain.long_blocks,
                      fmt::format("geometry.chains[{}]", c), &bond);
  if (geometry.window) bond = with_supports(bond, surface.held_end);
  std::vector<std::string> members = member_names(geometry);
  if (geometry.drum) {
    surface.first_bed_held = false;
    surface.rings_below = rings_of(*finest_bond(*geometry.drum));
    if (members.empty()) members = {"shell"};
  }
  return {"shell", std::move(surface), std::move(bond), std::move(members), stage};
}

std::vector<Storey> make_storeys(const Geometry& geometry) {
  std::vector<Storey> storeys{make_shell(geometry)};
  if (geometry.drum) storeys.insert(storeys.begin(), make_drum(*geometry.drum, storeys.front().surface));
  return storeys;
}

}  // namespace cupola
