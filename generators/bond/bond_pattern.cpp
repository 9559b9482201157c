#include "generators/bond/bond_pattern.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

std::vector<double> equal_cuts(double extent, double start, int count) {
  std::vector<double> cuts;
  for (int s = 0; s <= count; ++s) cuts.push_back(start + extent * s / count);
  return cuts;
}

void split_at_corners(const BondGrid& grid, BondPattern* pattern) {
  const double rounding = 1e-9 * grid.extent;  // nearer cuts and corners coincide
  BondPattern split = *pattern;
  split.cuts = {pattern->cuts.front()};
  std::vector<int> old_slice;
  for (int s = 0; s < pattern->num_slices(); ++s) {
    const double start = pattern->cuts[s], end = pattern->cuts[s + 1];
    std::vector<double> inside;
    for (double corner : grid.corners)
      for (double c : {corner, corner + grid.extent})  // the first cut may be above 0
        if (c > start + rounding && c < end - rounding) inside.push_back(c);
    std::ranges::sort(inside);
    inside.push_back(end);
    for (double cut : inside) {
      split.cuts.push_back(cut);
      old_slice.push_back(s);
    }
  }
  split.block_of.clear();
  for (int ring = 0; ring < pattern->num_rings; ++ring)
    for (int s : old_slice) split.block_of.push_back(pattern->at(ring, s));
  *pattern = std::move(split);
}

void mirror(double extent, BondPattern* pattern) {
  const int num_slices = pattern->num_slices();
  std::ranges::reverse(pattern->cuts);
  for (double& cut : pattern->cuts) cut = extent - cut;
  // Keep the first cut in [0, extent).
  const double shift = std::floor(pattern->cuts.front() / extent + 1e-12) * extent;
  for (double& cut : pattern->cuts) cut -= shift;
  for (int ring = 0; ring < pattern->num_rings; ++ring) {
    const auto row = pattern->block_of.begin() + static_cast<std::ptrdiff_t>(ring) * num_slices;
    std::reverse(row, row + num_slices);
  }
}

}  // namespace cupola
