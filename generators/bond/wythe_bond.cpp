#include "generators/bond/wythe_bond.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/base/error.hpp"
#include "generators/bond/drawing.hpp"
#include "generators/bond/make_bond.hpp"
#include "generators/bond/rests.hpp"

namespace cupola {
namespace {

/// Bonders as rectangles of the unrolled surface.
struct BonderPlaces {
  const Bonders& bonders;
  const BondGrid& grid;
  double spacing() const { return grid.extent / bonders.per_ring; }
  double origin() const { return grid.corners.empty() ? 0.0 : grid.corners.front(); }

  /// Number of the course among those with these bonders, or -1. `in_range` courses of the height range lie
  /// below.
  int course(int in_range) const {
    const int beyond = in_range - bonders.first;
    return beyond < 0 || beyond % bonders.every != 0 ? -1 : beyond / bonders.every;
  }
  double shift(int course) const { return course % 2 == 0 ? 0.0 : bonders.shift; }  // spacings
  /// The bonder at an abscissa, as (position in `at`, number), or none.
  std::optional<std::pair<int, int>> find(int course, double abscissa) const {
    for (size_t i = 0; i < bonders.at.size(); ++i) {
      const double spacings = (abscissa - origin()) / spacing() - bonders.at[i] - shift(course);
      const int number = static_cast<int>(std::floor(spacings + 0.5));
      if (std::abs(spacings - number) >= 0.5 * bonders.width) continue;
      const int n = bonders.per_ring;
      return std::pair(static_cast<int>(i), grid.closed ? (number % n + n) % n : number);
    }
    return std::nullopt;
  }
  void add_cuts(std::vector<double>* cuts) const {
    for (const double position : bonders.at)
      for (const double shifted : {0.0, bonders.shift})
        for (const double side : {-0.5, 0.5})
          for (int i = -2; i <= bonders.per_ring; ++i)
            cuts->push_back(origin() + (i + position + shifted + side * bonders.width) * spacing());
  }
};

/// The cuts of all wythes and bonders. (num_slices + 1)
std::vector<double> common_cuts(const std::vector<BondPattern>& wythes,
                                const std::vector<BonderPlaces>& bonders, const BondGrid& grid) {
  if (wythes.size() == 1 && bonders.empty()) return wythes.front().cuts;
  const double extent = grid.extent, rounding = 1e-9 * extent;  // nearer cuts coincide
  std::vector<double> all = grid.corners;
  for (const BondPattern& wythe : wythes) all.insert(all.end(), wythe.cuts.begin(), wythe.cuts.end());
  for (const BonderPlaces& places : bonders) places.add_cuts(&all);
  if (grid.closed)
    for (double& cut : all) {
      cut -= extent * std::floor(cut / extent);
      if (cut > extent - rounding) cut = 0.0;
    }
  std::ranges::sort(all);
  std::vector<double> cuts;
  for (const double cut : all) {
    const bool inside = grid.closed || (cut > -rounding && cut < extent + rounding);
    if (inside && (cuts.empty() || cut > cuts.back() + rounding)) cuts.push_back(cut);
  }
  if (grid.closed) cuts.push_back(cuts.front() + extent);
  return cuts;
}

/// Slice of a pattern that contains an abscissa.
int slice_at(const BondPattern& pattern, double abscissa, const BondGrid& grid) {
  if (grid.closed) {
    while (abscissa < pattern.cuts.front()) abscissa += grid.extent;
    while (abscissa >= pattern.cuts.back()) abscissa -= grid.extent;
  }
  const auto above = std::ranges::upper_bound(pattern.cuts, abscissa);
  return std::clamp(static_cast<int>(above - pattern.cuts.begin()) - 1, 0, pattern.num_slices() - 1);
}

double middle_of_slice(const BondPattern& pattern, int slice) {
  return 0.5 * (pattern.cuts[slice] + pattern.cuts[slice + 1]);
}

/// Lays a wythe in its courses, of one or more rings of the pattern each: those whose middle lies in its
/// range. Its blocks follow those laid before.
void lay_wythe(const Wythe& wythe, const BondPattern& own, int index, const BondGrid& grid,
               const std::vector<double>& heights, BondPattern* pattern) {
  const int offset = static_cast<int>(pattern->blocks.size()), courses = pattern->num_rings / own.num_rings;
  for (BondBlock block : own.blocks) {
    block.member = index;
    pattern->blocks.push_back(block);
  }
  for (int slice = 0; slice < pattern->num_slices(); ++slice) {
    const int from = slice_at(own, middle_of_slice(*pattern, slice), grid);
    for (int ring = 0; ring < pattern->num_rings; ++ring) {
      const int block = own.at(ring / courses, from), first = ring - ring % courses;
      const double middle = 0.5 * (heights[first] + heights[first + courses - 1]);
      if (block != kVoid && wythe.where.contains(middle)) pattern->at(ring, slice, index) = offset + block;
    }
  }
}

/// Lays bonders over wythes [from, to].
void lay_bonders(const BonderPlaces& places, int member, int from, int to, const std::vector<double>& heights,
                 BondPattern* pattern) {
  int in_range = 0;
  for (int ring = 0; ring < pattern->num_rings; ++ring) {
    if (!places.bonders.where.contains(heights[ring])) continue;
    const int course = places.course(in_range++);
    if (course < 0) continue;
    std::map<std::pair<int, int>, int> block_at;
    for (int slice = 0; slice < pattern->num_slices(); ++slice) {
      const auto place = places.find(course, middle_of_slice(*pattern, slice));
      if (!place) continue;
      const auto [block, is_new] = block_at.try_emplace(*place, static_cast<int>(pattern->blocks.size()));
      if (is_new) pattern->blocks.push_back({.member = member});
      for (int wythe = from; wythe <= to; ++wythe) pattern->at(ring, slice, wythe) = block->second;
    }
  }
}

/// What lays the blocks that drawings of neighbouring wythes have in common.
constexpr const char* kHeaders = "headers";

/// Drawn wythes side by side, which may share letters.
std::vector<std::vector<const DrawnBond*>> groups_of_drawings(const Masonry& masonry) {
  std::vector<std::vector<const DrawnBond*>> groups(1);
  for (const Wythe& wythe : masonry.wythes) {
    const auto* drawn = wythe.bond ? std::get_if<DrawnBond>(&*wythe.bond) : nullptr;
    if (drawn)
      groups.back().push_back(drawn);
    else if (!groups.back().empty())
      groups.emplace_back();
  }
  std::erase_if(groups, [](const auto& group) { return group.size() < 2; });
  return groups;
}

bool has_drawn_headers(const Masonry& masonry) {
  return std::ranges::any_of(groups_of_drawings(masonry), [](const auto& group) {
    const BondDrawing drawing(group);
    return std::ranges::any_of(drawing.blocks(), [](const DrawnBlock& block) { return block.wythes > 1; });
  });
}

/// Makes one block of those that have the same letter at one place in two wythes.
void join_headers(int member, BondPattern* pattern) {
  DisjointSets joined(pattern->blocks.size());
  const auto letter = [&](int block) { return block == kVoid ? char{0} : pattern->blocks[block].letter; };
  for (int ring = 0; ring < pattern->num_rings; ++ring)
    for (int slice = 0; slice < pattern->num_slices(); ++slice)
      for (int wythe = 1; wythe < pattern->num_wythes; ++wythe) {
        const int inner = pattern->at(ring, slice, wythe - 1), outer = pattern->at(ring, slice, wythe);
        if (letter(inner) == 0 || letter(inner) != letter(outer)) continue;
        joined.join(inner, outer);
        for (const int block : {inner, outer}) pattern->blocks[block].member = member;
      }
  for (int& block : pattern->block_of) {
    if (block == kVoid) continue;
    const int first = joined.root(block);
    if (pattern->blocks[block].truncated) pattern->blocks[first].truncated = true;
    block = first;
  }
}

int index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

void check_members(const std::vector<std::string>& names, const Masonry& masonry,
                   const BondPattern& pattern) {
  std::vector<char> exists(names.size(), 0);
  for (const Wythe& wythe : masonry.wythes)
    if (!wythe.bond) exists[index_of(names, wythe.name)] = 1;
  for (const BondBlock& block : pattern.blocks) exists[block.member] = 1;
  for (size_t i = 0; i < names.size(); ++i)
    if (!exists[i])
      throw InputError(fmt::format(
          "geometry.{}: {} has no block: no course lies in its height range, or bonders replace all blocks",
          i < masonry.wythes.size() ? "wythes" : "bonders", names[i]));
}

}  // namespace

std::vector<std::string> member_names(const Masonry& masonry) {
  std::vector<std::string> names;
  for (const Wythe& wythe : masonry.wythes) names.push_back(wythe.name);
  if (has_drawn_headers(masonry)) {
    if (std::ranges::find(names, kHeaders) != names.end())
      throw InputError(fmt::format(
          "geometry.wythes: no wythe can be called {}, the name of the blocks that drawings of neighbouring "
          "wythes share; choose another",
          kHeaders));
    names.emplace_back(kHeaders);
  }
  for (const Bonders& bonders : masonry.bonders)
    if (std::ranges::find(names, bonders.name) == names.end()) names.push_back(bonders.name);
  return names;
}

BondPattern make_wythe_bond(const Masonry& masonry, const BondGrid& grid,
                            const std::vector<double>& heights) {
  const std::vector<Wythe>& wythes = masonry.wythes;
  std::vector<BondPattern> own;
  for (const Wythe& wythe : wythes) {
    if (!wythe.bond) continue;
    BondGrid courses = grid;
    courses.num_rings = rings_of(*wythe.bond);
    own.push_back(make_bond(*wythe.bond, courses));
  }
  std::vector<BonderPlaces> places;
  for (const Bonders& bonders : masonry.bonders) places.push_back({bonders, grid});

  BondPattern pattern;
  pattern.num_rings = grid.num_rings;
  pattern.num_wythes = static_cast<int>(wythes.size());
  pattern.cuts = common_cuts(own, places, grid);
  pattern.block_of.assign(pattern.cell(grid.num_rings, 0), kVoid);
  size_t next = 0;
  for (size_t i = 0; i < wythes.size(); ++i)
    if (wythes[i].bond) lay_wythe(wythes[i], own[next++], static_cast<int>(i), grid, heights, &pattern);
  const std::vector<std::string> names = member_names(masonry);  // those of the wythes first
  join_headers(index_of(names, kHeaders), &pattern);
  std::vector<int> laid = cells_per_block(pattern);
  for (const BonderPlaces& group : places)
    lay_bonders(group, index_of(names, group.bonders.name), index_of(names, group.bonders.from),
                index_of(names, group.bonders.to), heights, &pattern);
  laid.resize(pattern.blocks.size(), 0);
  separate_rests(grid.closed, laid, &pattern);
  check_members(names, masonry, pattern);
  return pattern;
}

}  // namespace cupola
