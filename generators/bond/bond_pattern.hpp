#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// What a bond needs to know about its surface.
struct BondGrid {
  int num_rings = 0;
  bool closed = false;          ///< the abscissa is an angle that wraps around
  double extent = 0.0;          ///< the abscissa runs from 0 to this
  std::vector<double> corners;  ///< abscissae that must be cuts
  /// A part of a ring: the bond is laid as on a ring of this extent, and cut where its ends meet.
  bool window = false;
  int built = 0;  ///< rings of the stage; 0: all
};

/// Label that the bond gives to a block.
struct BondBlock {
  BlockKind kind = BlockKind::standard;
  bool truncated =
      false;        ///< cut: an upright that is shorter, or a flat block that is not as wide as a whole one
  int spiral = -1;  ///< of an upright block; -1 for none
};

/// A bond: the cuts between slices along the abscissa, and the block of each cell of the (rings x slices)
/// grid. The cells of one block in one ring are neighbours.
struct BondPattern {
  int num_rings = 0;
  std::vector<double> cuts;   ///< ascending; the last is the first plus the extent; (num_slices + 1)
  std::vector<int> block_of;  ///< index into `blocks`, ring by ring; (num_rings x num_slices)
  std::vector<BondBlock> blocks;

  int num_slices() const { return static_cast<int>(cuts.size()) - 1; }
  int& at(int ring, int slice) { return block_of[static_cast<size_t>(ring) * num_slices() + slice]; }
  int at(int ring, int slice) const { return block_of[static_cast<size_t>(ring) * num_slices() + slice]; }
};

/// Cuts of `count` equal slices, the first at `start`. (count + 1)
std::vector<double> equal_cuts(double extent, double start, int count);

/// Splits every slice that contains a corner of the surface, so that all corners are cuts.
void split_at_corners(const BondGrid& grid, BondPattern* pattern);

/// Moves the bond of a closed ring by `shift` along the abscissa and cuts it at abscissa 0, so that its cuts
/// run from 0 to the extent. Blocks across this place become two, both marked as truncated.
void open_ring(double extent, double shift, BondPattern* pattern);

/// Mirrors the bond: abscissa a becomes extent - a.
void mirror(double extent, BondPattern* pattern);

}  // namespace cupola
