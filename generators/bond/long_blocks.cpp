#include "generators/bond/long_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/bond/rests.hpp"

namespace cupola {

std::set<int> equal_starts(const BondGrid& grid, const std::vector<double>& cuts, int count, double phase) {
  const auto distance = [&](double a, double b) { return std::abs(std::remainder(a - b, grid.extent)); };
  std::vector<int> candidates;
  for (int slice = 0; slice + 1 < static_cast<int>(cuts.size()); ++slice)
    if (std::ranges::none_of(
            grid.corners, [&](double corner) { return distance(corner, cuts[slice]) < 1e-9 * grid.extent; }))
      candidates.push_back(slice);
  std::set<int> starts;
  const double first = grid.corners.empty() ? cuts.front() : grid.corners.front();
  for (int block = 0; block < count && !candidates.empty(); ++block) {
    const double start = first + (block + phase) * grid.extent / count;
    starts.insert(
        *std::ranges::min_element(candidates, {}, [&](int slice) { return distance(cuts[slice], start); }));
  }
  return starts;
}

void lay_long_blocks(const BondGrid& grid, int first_ring, int last_ring, int count, const std::string& key,
                     BondPattern* pattern) {
  CUPOLA_ASSERT(grid.closed && first_ring >= 0 && last_ring < pattern->num_rings && count >= 1);
  const int num_slices = pattern->num_slices();
  std::set<int> outside;
  for (int ring = 0; ring < pattern->num_rings; ++ring)
    for (int slice = 0; slice < num_slices && (ring < first_ring || ring > last_ring); ++slice)
      outside.insert(pattern->at(ring, slice));
  outside.erase(kVoid);
  const std::set<int> starts = equal_starts(grid, pattern->cuts, count, grid.corners.empty() ? 0.0 : -0.5);
  if (std::ssize(starts) < count)
    throw InputError(
        fmt::format("{}.long_blocks = {}: the bond has only {} cuts round the course; give fewer", key, count,
                    num_slices));
  const int new_block = static_cast<int>(pattern->blocks.size());
  pattern->blocks.resize(pattern->blocks.size() + static_cast<size_t>(count));
  for (int ring = first_ring; ring <= last_ring; ++ring) {
    int block = new_block + count - 1;  // begins before the seam
    for (int slice = 0; slice < num_slices; ++slice) {
      if (outside.contains(pattern->at(ring, slice)))
        throw InputError(
            fmt::format("{}.long_blocks: uprights stand in the course; choose a course that the "
                        "herringbone does not cross, or long_blocks: 0",
                        key));
      if (starts.contains(slice)) block = block == new_block + count - 1 ? new_block : block + 1;
      pattern->at(ring, slice) = block;
    }
  }
  separate_rests(grid.closed, cells_per_block(*pattern), pattern);
}

}  // namespace cupola
