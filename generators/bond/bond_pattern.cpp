#include "generators/bond/bond_pattern.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {
namespace {

/// Gives the left part of every block that lies on both sides of the seam a number of its own.
void cut_at_seam(BondPattern* pattern) {
  const int last = pattern->num_slices() - 1;
  std::vector<int> left_part(pattern->blocks.size(), -1);
  for (int ring = 0; ring < pattern->num_rings; ++ring) {
    const int block = pattern->at(ring, 0);
    if (block == kVoid || pattern->at(ring, last) != block) continue;
    int end = 0;
    while (end <= last && pattern->at(ring, end) == block) ++end;
    if (end > last) continue;  // the whole ring is one block
    pattern->blocks[block].truncated = true;
    if (left_part[block] < 0) {
      left_part[block] = static_cast<int>(pattern->blocks.size());
      pattern->blocks.push_back(pattern->blocks[block]);
    }
    for (int s = 0; s < end; ++s) pattern->at(ring, s) = left_part[block];
  }
}

}  // namespace

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
    for (int s : old_slice)
      for (int wythe = 0; wythe < pattern->num_wythes; ++wythe)
        split.block_of.push_back(pattern->at(ring, s, wythe));
  *pattern = std::move(split);
}

BondPattern stack_of_courses(const std::vector<BondPattern>& courses) {
  BondPattern out;
  out.num_rings = static_cast<int>(courses.size());
  for (const BondPattern& course : courses) {
    out.cuts_of_course.push_back(course.cuts);
    if (course.cuts.size() > out.cuts.size()) out.cuts = course.cuts;
  }
  out.block_of.assign(static_cast<size_t>(out.num_rings) * out.num_slices(), kVoid);
  for (int ring = 0; ring < out.num_rings; ++ring) {
    const BondPattern& course = courses[static_cast<size_t>(ring)];
    const int before = static_cast<int>(out.blocks.size());
    out.blocks.insert(out.blocks.end(), course.blocks.begin(), course.blocks.end());
    for (int slice = 0; slice < course.num_slices(); ++slice)
      if (const int block = course.at(0, slice); block != kVoid) out.at(ring, slice) = before + block;
  }
  return out;
}

bool has_empty_cells(const BondPattern& pattern) {
  for (int ring = 0; ring < pattern.num_rings; ++ring)
    for (int slice = 0; slice < pattern.slices_of(ring); ++slice)
      for (int wythe = 0; wythe < pattern.num_wythes; ++wythe)
        if (pattern.at(ring, slice, wythe) == kVoid) return true;
  return false;
}

void open_ring(double extent, double shift, BondPattern* pattern) {
  const double rounding = 1e-9 * extent;
  const int num_slices = pattern->num_slices();
  const double turns = std::floor((pattern->cuts.front() + shift + rounding) / extent);
  for (double& cut : pattern->cuts) cut += shift - turns * extent;
  // Slices from `first` onwards lie beyond the extent and come to the front; the one before may be split.
  int first = 1;
  while (pattern->cuts[first] < extent - rounding) ++first;
  BondPattern open = *pattern;
  open.cuts = {0.0};
  std::vector<int> old_slice;
  const auto append = [&](int slice, double end) {
    if (end <= open.cuts.back() + rounding) return;
    open.cuts.push_back(end);
    old_slice.push_back(slice);
  };
  append(first - 1, pattern->cuts[first] - extent);
  for (int s = first; s < num_slices; ++s) append(s, pattern->cuts[s + 1] - extent);
  for (int s = 0; s < first; ++s) append(s, std::min(pattern->cuts[s + 1], extent));
  open.cuts.back() = extent;
  open.block_of.clear();
  for (int ring = 0; ring < pattern->num_rings; ++ring)
    for (int s : old_slice) open.block_of.push_back(pattern->at(ring, s));
  *pattern = std::move(open);
  cut_at_seam(pattern);
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
