#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// What a bond needs to know of the surface it lies on.
struct BondGrid {
  int num_rings = 0;
  bool closed = false;          ///< the abscissa is an azimuth that wraps around
  double extent = 0.0;          ///< range of the abscissa, from 0
  std::vector<double> corners;  ///< abscissae that must be slice cuts
};

/// What the bond says of one block.
struct BondBlock {
  BlockKind kind = BlockKind::standard;
  bool truncated = false;  ///< cut short by the base or the crown
  int spiral = -1;
};

/// A bond: slice cuts along the abscissa, and the block each cell of the (rings x slices) grid belongs to.
/// The cells of one block in one ring are neighbours.
struct BondPattern {
  int num_rings = 0;
  std::vector<double> cuts;   ///< ascending (num_slices + 1); closed: the last is the first plus the extent
  std::vector<int> block_of;  ///< (num_rings x num_slices), ring by ring
  std::vector<BondBlock> blocks;

  int num_slices() const { return static_cast<int>(cuts.size()) - 1; }
  int& at(int ring, int slice) { return block_of[static_cast<size_t>(ring) * num_slices() + slice]; }
  int at(int ring, int slice) const { return block_of[static_cast<size_t>(ring) * num_slices() + slice]; }
};

/// `count` equal slices from `start` on (count + 1).
std::vector<double> lattice_cuts(double extent, double start, int count);

/// Splits every slice that a corner of the surface lies in, so that corners are cuts.
void split_at_corners(const BondGrid& grid, BondPattern* pattern);

/// Turns the abscissa round: a becomes extent - a.
void mirror(double extent, BondPattern* pattern);

}  // namespace cupola
