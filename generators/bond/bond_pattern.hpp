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
  int built = 0;                     ///< rings of the stage; 0: all
  double length = 0.0;               ///< m, of the first bed, on the intrados
  double thickness = 0.0;            ///< m, of the first course, between its beds on the intrados
  std::vector<double> lengths = {};  ///< m, of the lower bed of each course; only for courses laid by length
  bool round = false;  ///< of these: the cuts of the first course become corners of facets in all
};

/// Instead of a block: an empty cell.
constexpr int kVoid = -1;

/// Label that the bond gives to a block.
struct BondBlock {
  BlockKind kind = BlockKind::standard;
  bool truncated =
      false;        ///< cut: an upright that is shorter, or a flat block that is not as wide as a whole one
  int spiral = -1;  ///< of an upright block; -1 for none
  int member = 0;   ///< what laid it: a wythe, or behind these a group of bonders
  char letter = 0;  ///< of a drawn bond
};

/// A bond: the cuts between slices along the abscissa, and the block of each cell of the (rings x slices x
/// wythes) grid. The cells of one block are connected by their faces. Courses may have cuts of their own; the
/// grid is then as wide as the course with the most slices, and what lies beyond those of a course is void.
struct BondPattern {
  int num_rings = 0;
  int num_wythes = 1;
  std::vector<double> cuts;   ///< ascending; the last is the first plus the extent; (num_slices + 1)
  std::vector<int> block_of;  ///< index into `blocks`, or kVoid; (num_rings x num_slices x num_wythes)
  std::vector<BondBlock> blocks;
  std::vector<std::vector<double>> cuts_of_course = {};  ///< of each course; none: `cuts`

  bool by_course() const { return !cuts_of_course.empty(); }
  const std::vector<double>& cuts_of(int ring) const { return by_course() ? cuts_of_course[ring] : cuts; }
  int slices_of(int ring) const { return static_cast<int>(cuts_of(ring).size()) - 1; }
  int num_slices() const { return static_cast<int>(cuts.size()) - 1; }
  size_t cell(int ring, int slice, int wythe = 0) const {
    return (static_cast<size_t>(ring) * num_slices() + slice) * num_wythes + wythe;
  }
  int& at(int ring, int slice, int wythe = 0) { return block_of[cell(ring, slice, wythe)]; }
  int at(int ring, int slice, int wythe = 0) const { return block_of[cell(ring, slice, wythe)]; }
};

/// Cuts of `count` equal slices, the first at `start`. (count + 1)
std::vector<double> equal_cuts(double extent, double start, int count);

/// Splits every slice that contains a corner of the surface, so that all corners are cuts.
void split_at_corners(const BondGrid& grid, BondPattern* pattern);

/// One pattern of courses with cuts of their own from one pattern for each course.
BondPattern stack_of_courses(const std::vector<BondPattern>& courses);

/// True if a slice of a course belongs to no block.
bool has_empty_cells(const BondPattern& pattern);

/// Moves the bond of a closed ring by `shift` along the abscissa and cuts it at abscissa 0, so that its cuts
/// run from 0 to the extent. Blocks across this place become two, both marked as truncated.
void open_ring(double extent, double shift, BondPattern* pattern);

/// Mirrors the bond: abscissa a becomes extent - a.
void mirror(double extent, BondPattern* pattern);

}  // namespace cupola
