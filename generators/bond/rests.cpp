#include "generators/bond/rests.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace cupola {
namespace {

/// Ring, slice and wythe.
using Cell = std::array<int, 3>;

bool is_box(const std::vector<Cell>& cells) {
  size_t box = 1;
  for (size_t i = 0; i < 3; ++i) {
    std::set<int> positions;
    for (const Cell& cell : cells) positions.insert(cell[i]);
    box *= positions.size();
  }
  return cells.size() == box;
}

/// Numbers the connected parts of the blocks of a pattern anew.
class Numbering {
 public:
  Numbering(const BondPattern& pattern, bool closed)
      : pattern_(pattern), closed_(closed), number_(pattern.block_of.size(), kVoid) {}

  bool is_numbered(const Cell& cell) const { return number(cell) != kVoid; }
  /// Gives the cells of the same block that are connected with `seed`, with `across_beds` also through beds,
  /// the next number, and returns them.
  std::vector<Cell> fill(const Cell& seed, bool across_beds) {
    std::vector<Cell> cells;
    const int block = pattern_.at(seed[0], seed[1], seed[2]), id = count_++;
    const auto visit = [&](Cell c) {
      const int num_slices = pattern_.num_slices();
      if (closed_) c[1] = (c[1] + num_slices) % num_slices;
      const bool inside = c[0] >= 0 && c[0] < pattern_.num_rings && c[1] >= 0 && c[1] < num_slices &&
                          c[2] >= 0 && c[2] < pattern_.num_wythes;
      if (!inside || pattern_.at(c[0], c[1], c[2]) != block || is_numbered(c)) return;
      number(c) = id;
      cells.push_back(c);
    };
    visit(seed);
    for (size_t i = 0; i < cells.size(); ++i)
      for (const int step : {-1, 1})
        for (size_t axis = across_beds ? 0 : 1; axis < 3; ++axis) {
          Cell next = cells[i];
          next[axis] += step;
          visit(next);
        }
    std::ranges::sort(cells);
    return cells;
  }
  /// Takes back the last number.
  void undo(const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) number(cell) = kVoid;
    --count_;
  }
  std::vector<int> numbers() && { return std::move(number_); }

 private:
  int& number(const Cell& c) { return number_[pattern_.cell(c[0], c[1], c[2])]; }
  int number(const Cell& c) const { return number_[pattern_.cell(c[0], c[1], c[2])]; }

  const BondPattern& pattern_;
  bool closed_;
  int count_ = 0;
  std::vector<int> number_;
};

}  // namespace

std::vector<int> cells_per_block(const BondPattern& pattern) {
  std::vector<int> count(pattern.blocks.size(), 0);
  for (const int block : pattern.block_of)
    if (block != kVoid) ++count[block];
  return count;
}

void separate_rests(bool closed, const std::vector<int>& laid, BondPattern* pattern) {
  Numbering numbering(*pattern, closed);
  std::vector<BondBlock> blocks;
  const auto add = [&](int block, const std::vector<Cell>& cells) {
    blocks.push_back(pattern->blocks[block]);
    if (static_cast<int>(cells.size()) < laid[block]) blocks.back().truncated = true;
  };
  for (int ring = 0; ring < pattern->num_rings; ++ring)
    for (int slice = 0; slice < pattern->num_slices(); ++slice)
      for (int wythe = 0; wythe < pattern->num_wythes; ++wythe) {
        const Cell seed{ring, slice, wythe};
        const int block = pattern->at(ring, slice, wythe);
        if (block == kVoid || numbering.is_numbered(seed)) continue;
        const std::vector<Cell> cells = numbering.fill(seed, true);
        if (static_cast<int>(cells.size()) == laid[block] || is_box(cells)) {
          add(block, cells);
          continue;
        }
        numbering.undo(cells);
        for (const Cell& cell : cells)
          if (!numbering.is_numbered(cell)) add(block, numbering.fill(cell, false));
      }
  pattern->block_of = std::move(numbering).numbers();
  pattern->blocks = std::move(blocks);
}

}  // namespace cupola
