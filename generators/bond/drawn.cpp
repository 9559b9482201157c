#include "generators/bond/drawn.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/bond/drawing.hpp"
#include "generators/bond/rests.hpp"

namespace cupola {
namespace {

constexpr double kMostCellsOfDrawing = 2e7;

/// Drawings round a course of a length (m), or letters along a wall.
double units_of(const DrawnBond& bond, int unit, double length) {
  return std::max(1.0, std::round(length / (unit * bond.letter_length / bond.refine)));
}

/// Number of letters along the first course.
int letters_of(const DrawnBond& bond, const BondGrid& grid) {
  constexpr double kLargestError = 0.05;  // of the length of a letter
  const double wanted = bond.letter_length / bond.refine;
  const int unit = grid.closed ? static_cast<int>(bond.rows.front().size()) : 1;
  const double units = units_of(bond, unit, grid.length);
  const double letters = units * unit, length = grid.length / letters;
  if (letters * grid.num_rings > kMostCellsOfDrawing)
    throw InputError(
        fmt::format("geometry.bond.letter_length = {}: gives {:.3g} letters, more than 2e7; make it longer",
                    bond.letter_length, letters * grid.num_rings));
  if (std::abs(length / wanted - 1.0) > kLargestError)
    throw InputError(fmt::format(
        "geometry.bond.letter_length = {}: a course of {:.4g} m takes {} of {} letters, of {:.4g} m each; "
        "write letter_length: {:.4g}, or change the drawing",
        bond.letter_length, grid.length, unit > 1 ? fmt::format("{:.0f} drawings", units) : "a whole number",
        unit > 1 ? unit : static_cast<int>(letters), length, length * bond.refine));
  return static_cast<int>(letters);
}

/// Letters from abscissa 0 to the drawing.
double phase_of(const DrawnBond& bond, const BondGrid& grid) {
  constexpr double kCornerPhase = 0.5;
  const double phase = bond.phase.value_or(grid.closed && !grid.corners.empty() ? kCornerPhase : 0.0);
  if (!grid.closed && phase != std::floor(phase))
    throw InputError(
        fmt::format("geometry.bond.phase = {}: must be a whole number of letters on an open surface", phase));
  return phase;
}

/// The drawing on the cells of a course, which it covers from slice 0 on.
class Laying {
 public:
  /// `first_row`: of the drawing, on the first course of the grid.
  Laying(const DrawnBond& bond, const BondGrid& grid, int num_letters, double phase, int first_row = 0)
      : bond_(bond),
        grid_(grid),
        drawing_({&bond}),
        num_letters_(num_letters),
        offset_(static_cast<int>(std::floor(phase))),
        first_row_(first_row) {
    pattern_.num_rings = grid.num_rings;
    pattern_.cuts = equal_cuts(grid.extent, grid.closed ? grid.extent * (phase - offset_) / num_letters : 0.0,
                               num_letters);
    pattern_.block_of.assign(static_cast<size_t>(grid.num_rings) * num_letters, kVoid);
  }

  BondPattern lay() && {
    for (int ring = 0; ring < grid_.num_rings; ++ring)
      for (int slice = 0; slice < num_letters_; ++slice)
        if (pattern_.at(ring, slice) == kVoid && kind_at(ring, slice) >= 0) lay_block(ring, slice);
    if (!grid_.closed) join_narrow_ends();
    return std::move(pattern_);
  }

 private:
  /// Where a block lies that was laid on an open surface.
  struct Extent {
    int whole_width;  ///< letters, as drawn
    int first_ring, last_ring, first_slice, last_slice;
    int width() const { return last_slice - first_slice + 1; }
  };

  int kind_at(int ring, int slice) const { return drawing_.block_of(slice - offset_, first_row_ + ring, 0); }
  int wrap(int slice) const { return grid_.closed ? (slice + num_letters_) % num_letters_ : slice; }

  void lay_block(int ring, int slice) {
    const int kind = kind_at(ring, slice), id = static_cast<int>(pattern_.blocks.size());
    std::vector<std::pair<int, int>> cells{{ring, slice}};
    pattern_.at(ring, slice) = id;
    for (size_t i = 0; i < cells.size(); ++i) {
      const auto [r, s] = cells[i];
      for (const auto& [nr, ns] : {std::pair(r, wrap(s - 1)), {r, wrap(s + 1)}, {r - 1, s}, {r + 1, s}}) {
        if (nr < 0 || nr >= grid_.num_rings || ns < 0 || ns >= num_letters_) continue;
        if (pattern_.at(nr, ns) != kVoid || !same_block(r, s, nr, ns)) continue;
        pattern_.at(nr, ns) = id;
        cells.emplace_back(nr, ns);
      }
    }
    const DrawnBlock& whole = drawing_.blocks()[static_cast<size_t>(kind)];
    BondBlock block{.truncated = static_cast<int>(cells.size()) < whole.cells, .letter = whole.letter};
    if (is_upright(whole)) block.kind = BlockKind::herringbone;
    pattern_.blocks.push_back(block);
    Extent extent{whole.width, ring, ring, slice, slice};
    for (const auto& [r, s] : cells)
      extent = {whole.width, std::min(extent.first_ring, r), std::max(extent.last_ring, r),
                std::min(extent.first_slice, s), std::max(extent.last_slice, s)};
    extents_.push_back(extent);
  }

  bool is_upright(const DrawnBlock& whole) const {
    const DrawnBond::LetterKind kind = bond_.kind_of(whole.letter);
    if (kind != DrawnBond::LetterKind::by_shape) return kind == DrawnBond::LetterKind::upright;
    const double width = whole.width * grid_.length / num_letters_, height = whole.height * grid_.thickness;
    return height > width && whole.height > 1;
  }

  /// Neighbouring cells of one letter belong to one block, because they touch.
  bool same_block(int ring, int slice, int other_ring, int other_slice) const {
    const int a = kind_at(ring, slice), b = kind_at(other_ring, other_slice);
    return a >= 0 && a == b;
  }

  /// Pieces at the two ends of a wall.
  void join_narrow_ends() {
    constexpr double kLeast = 0.25;  // of the width of the whole block
    for (const int step : {1, -1})
      for (int ring = 0; ring < grid_.num_rings; ++ring) {
        const int piece = pattern_.at(ring, step > 0 ? 0 : num_letters_ - 1);
        if (piece == kVoid || !pattern_.blocks[static_cast<size_t>(piece)].truncated) continue;
        const Extent& extent = extents_[static_cast<size_t>(piece)];
        if (extent.width() < kLeast * extent.whole_width) give_away(piece, step);
      }
    separate_rests(grid_.closed, cells_per_block(pattern_), &pattern_);
  }

  /// Gives the cells of a piece, course by course, to the block behind them.
  void give_away(int piece, int step) {
    const Extent& extent = extents_[static_cast<size_t>(piece)];
    const int reach = step > 0 ? extent.last_slice : num_letters_ - 1 - extent.first_slice;
    for (int ring = extent.first_ring; ring <= extent.last_ring; ++ring)
      for (int i = reach; i >= 0; --i) {
        const int slice = step > 0 ? i : num_letters_ - 1 - i, behind = slice + step;
        if (behind < 0 || behind >= num_letters_ || pattern_.at(ring, slice) != piece) continue;
        if (pattern_.at(ring, behind) != kVoid) pattern_.at(ring, slice) = pattern_.at(ring, behind);
      }
  }

  const DrawnBond& bond_;
  const BondGrid& grid_;
  BondDrawing drawing_;
  int num_letters_, offset_, first_row_;
  BondPattern pattern_;
  std::vector<Extent> extents_;
};

/// Each course by itself, with its own number of letters.
BondPattern lay_by_length(const DrawnBond& bond, const BondGrid& grid, double phase) {
  const BondDrawing drawing({&bond});
  for (const DrawnBlock& block : drawing.blocks())
    if (block.height > 1)
      throw InputError(fmt::format(
          "geometry.bond.length = constant: a block of letters {} is {} courses high, but courses "
          "differ in their numbers of letters; draw blocks of one course",
          block.letter, block.height));
  const int unit = static_cast<int>(bond.rows.front().size());
  BondGrid course = grid;
  course.num_rings = 1;
  std::vector<BondPattern> courses;
  for (int ring = 0; ring < grid.num_rings; ++ring) {
    course.length = grid.lengths[static_cast<size_t>(ring)];
    const double whole = unit * bond.letter_length / bond.refine;
    if (course.length < 0.5 * whole)
      throw InputError(
          fmt::format("geometry.bond.length = constant: course {}, of {:.3g} m, is shorter than half a "
                      "drawing of {:.3g} m; "
                      "choose a larger eye or a shorter letter_length",
                      ring, course.length, whole));
    const int letters = unit * static_cast<int>(units_of(bond, unit, course.length));
    courses.push_back(Laying(bond, course, letters, phase, ring).lay());
    split_at_corners(course, &courses.back());
    if (ring > 0 || !grid.round) continue;
    course.corners.clear();  // in [0, extent), as the corners of a surface
    for (int slice = 0; slice < courses.front().num_slices(); ++slice)
      course.corners.push_back(std::fmod(courses.front().cuts[static_cast<size_t>(slice)], grid.extent));
  }
  return stack_of_courses(courses);
}

}  // namespace

BondPattern lay_drawing(const DrawnBond& bond, const BondGrid& grid, int num_letters, double phase) {
  BondPattern pattern = Laying(bond, grid, num_letters, phase).lay();
  split_at_corners(grid, &pattern);
  return pattern;
}

BondPattern drawn_bond(const DrawnBond& bond, const BondGrid& grid) {
  const int num_letters = letters_of(bond, grid);
  const double phase = phase_of(bond, grid);
  if (bond.length == DrawnBond::Length::constant) return lay_by_length(bond, grid, phase);
  const BondDrawing drawing({&bond});
  if (grid.closed)
    for (const DrawnBlock& block : drawing.blocks())
      if (block.width >= num_letters)
        throw InputError(
            fmt::format("geometry.bond.rows: a block of {} letters {} does not fit into a ring of {}; make "
                        "letter_length shorter",
                        block.width, block.letter, num_letters));
  return lay_drawing(bond, grid, num_letters, phase);
}

}  // namespace cupola
