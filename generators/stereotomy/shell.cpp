#include "generators/stereotomy/shell.hpp"

#include "generators/bond/make_bond.hpp"
#include "generators/surface/make_surface.hpp"
#include "generators/surface/window.hpp"

namespace cupola {
namespace {

/// Adds the supports of a window: a row below the first, and with held ends a slice beyond each end.
BondPattern with_supports(const BondPattern& bond, double held_end) {
  const int beyond = held_end > 0.0 ? 1 : 0;  // slices
  BondPattern out;
  out.num_rings = bond.num_rings + 1;
  if (beyond > 0) out.cuts.push_back(-held_end);
  out.cuts.insert(out.cuts.end(), bond.cuts.begin(), bond.cuts.end());
  if (beyond > 0) out.cuts.push_back(bond.cuts.back() + held_end);
  out.blocks = bond.blocks;
  const int base = static_cast<int>(out.blocks.size()), num_slices = bond.num_slices();
  out.blocks.resize(out.blocks.size() + 1 + 2 * static_cast<size_t>(beyond), {BlockKind::support, false, -1});
  for (int row = 0; row < out.num_rings; ++row) {
    if (beyond > 0) out.block_of.push_back(base + 1);
    for (int s = 0; s < num_slices; ++s) out.block_of.push_back(row == 0 ? base : bond.at(row - 1, s));
    if (beyond > 0) out.block_of.push_back(base + 2);
  }
  return out;
}

}  // namespace

Shell make_shell(const Geometry& geometry) {
  const int courses = rings_of(geometry.bond);
  const int stage = geometry.stage ? geometry.stage->rings * refinement_of(geometry.bond) : 0;
  SurfaceMap surface = geometry.window ? window_surface(geometry.surface, *geometry.window, courses,
                                                        stage > 0 ? stage : courses, geometry.support_width)
                                       : make_surface(geometry.surface, courses);
  BondPattern bond = make_bond(geometry.bond, {surface.num_rings(), surface.closed, surface.extent,
                                               surface.corners, geometry.window.has_value(), stage});
  if (geometry.window) bond = with_supports(bond, surface.held_end);
  return {std::move(surface), std::move(bond), stage};
}

}  // namespace cupola
