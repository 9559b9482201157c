#include "generators/bond/openings.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "generators/bond/rests.hpp"

namespace cupola {
namespace {

/// Writes `block` into the cells of rings [first, end) within `half` of the middle of an opening.
void fill_cells(const BondGrid& grid, double middle, double half, int first, int end, int block,
                BondPattern* pattern) {
  for (int slice = 0; slice < pattern->num_slices(); ++slice) {
    const double abscissa = 0.5 * (pattern->cuts[slice] + pattern->cuts[slice + 1]);
    if (std::abs(std::remainder(abscissa - middle, grid.extent)) >= half) continue;
    for (int ring = first; ring < end; ++ring)
      for (int wythe = 0; wythe < pattern->num_wythes; ++wythe) pattern->at(ring, slice, wythe) = block;
  }
}

/// Abscissae of the jambs and of the ends of the lintels, ascending in [0, extent).
std::vector<double> edges_of(const BondGrid& grid, const std::vector<OpeningPlace>& openings) {
  std::vector<double> edges;
  for (const OpeningPlace& place : openings)
    for (const double half : {place.half_opening, place.half_lintel})
      for (const double edge : {place.middle - half, place.middle + half})
        edges.push_back(edge - grid.extent * std::floor(edge / grid.extent));
  std::ranges::sort(edges);
  const auto coincide = [&](double a, double b) {
    return b - a < 1e-9 * grid.extent;
  };  // as in split_at_corners()
  edges.erase(std::unique(edges.begin(), edges.end(), coincide), edges.end());
  return edges;
}

}  // namespace

void lay_openings(const BondGrid& grid, const std::vector<OpeningPlace>& openings, int member,
                  BondPattern* pattern) {
  CUPOLA_ASSERT(grid.closed);
  if (openings.empty()) return;
  BondGrid edges = grid;
  edges.corners = edges_of(grid, openings);
  split_at_corners(edges, pattern);
  const int laid_before = static_cast<int>(pattern->blocks.size());
  std::vector<int> laid = cells_per_block(*pattern);
  for (const OpeningPlace& place : openings) {
    fill_cells(grid, place.middle, place.half_lintel, place.first_lintel, place.end_lintel,
               static_cast<int>(pattern->blocks.size()), pattern);
    pattern->blocks.push_back({.member = member});
  }
  const std::vector<int> with_lintels = cells_per_block(*pattern);
  laid.insert(laid.end(), with_lintels.begin() + laid_before, with_lintels.end());
  for (const OpeningPlace& place : openings)
    fill_cells(grid, place.middle, place.half_opening, place.first_ring, place.first_lintel, kVoid, pattern);
  separate_rests(grid.closed, laid, pattern);
}

}  // namespace cupola
