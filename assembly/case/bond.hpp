#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "assembly/base/named_enum.hpp"

namespace cupola {

// Every bond has `refine`, which splits each course into that many courses and each block into that many
// blocks in the same bond. Counts and default phases below are those before refinement. Blocks stay as thick
// as the shell.

/// Running bond: every ring has the same number of blocks; odd rings are shifted by half a block. On a wall,
/// odd courses end in half blocks.
struct RunningBond {
  int rings = 40;            ///< courses, >= 1
  int blocks_per_ring = 32;  ///< >= 1 on a wall, >= 3 on a dome
  int slices_per_block = 4;  ///< azimuthal cells per block, even
  /// Block widths from the first corner to the first head joint; none: 1/4 on a vault with corners, so that
  /// no joint lies on a corner, else 0.
  std::optional<double> phase = {};
  int refine = 1;  ///< >= 1
};

/// Stack bond: all head joints aligned.
struct StackBond {
  int rings = 40;
  int blocks_per_ring = 32;
  int slices_per_block = 4;
  std::optional<double> phase = {};  ///< as in RunningBond
  int refine = 1;                    ///< >= 1
};

/// Narrow upright blocks ("verticals") that climb through whole blocks laid flat. On closed surfaces they
/// form spirals that advance by the width of one vertical per ring; on a wall, one diagonal from corner to
/// corner.
struct HerringboneBond {
  enum class Chirality : std::uint8_t { right, left, both };
  enum class Path : std::uint8_t { spiral, meridian };
  /// Head joints of the flat blocks: step with the spirals, keep a half bond, or lie on meridians.
  enum class Beside : std::uint8_t { stepped, half, aligned };

  int rings = 40;
  int blocks_per_ring = 32;     ///< whole blocks that would fill a ring
  int spirals = 8;              ///< also the number of meridian strips
  int rings_per_vertical = 3;   ///< height of a vertical
  int verticals_per_block = 3;  ///< width of a whole block over the width of a vertical
  Path path = Path::spiral;     ///< `meridian`: strips that climb straight up
  Chirality chirality =
      Chirality::right;  ///< right: climbs counter-clockwise seen from above; both: they cross
  /// Courses by which the upright of a spiral in the last course stands in the courses below, from 0 to
  /// rings_per_vertical - 1. Each course then crosses one upright of each spiral. -1: one new upright per
  /// spiral and course, so that each course crosses uprights of every embedment.
  int embedment = -1;
  Beside beside = Beside::stepped;
  std::optional<double> phase = {};  ///< block widths from the first corner to the first spiral's start;
                                     ///< none: 1/6 on a vault with corners, else 0
  int slices_per_vertical = 1;       ///< azimuthal cells per vertical
  int refine = 1;                    ///< >= 1; each spiral becomes that many spirals side by side in its band
};
constexpr auto enum_names(HerringboneBond::Chirality) {
  return std::array{"right", "left", "both"};
}
constexpr auto enum_names(HerringboneBond::Path) {
  return std::array{"spiral", "meridian"};
}
constexpr auto enum_names(HerringboneBond::Beside) {
  return std::array{"stepped", "half", "aligned"};
}

/// Whole blocks of unequal width, chosen ring by ring (dynamic programming) so that head joints avoid the
/// joints of the ring below and the corners of the vault.
struct FillBond {
  int rings = 40;
  int blocks_per_ring = 32;  ///< sets the mean width
  int slices_per_block = 8;  ///< head joints lie at multiples of the mean width over this
  double narrowest = 0.75;   ///< of the mean width, in (0, 1]
  double widest = 1.25;      ///< of the mean width, >= 1
  int refine = 1;            ///< >= 1
};

/// A bond drawn in letters. Cell (c, r) of the infinite pattern, r upwards from the first course, has the
/// letter rows[R - 1 - r mod R][(c - shift * floor(r / R)) mod C] of the R rows of C letters, as seen from
/// outside. The cells of one letter that are connected through their faces form a block; `.` is empty.
struct DrawnBond {
  /// Upright blocks have joints and colours of their own. By shape, a block is upright if it is taller than
  /// wide.
  enum class LetterKind : std::uint8_t { by_shape, flat, upright };
  /// Of a letter in courses that shorten: it narrows with them, or each course has letters of its own number.
  enum class Length : std::uint8_t { narrowing, constant };

  int rings = 40;
  std::vector<std::string> rows;  ///< the uppermost course first, all of one length
  double letter_length = 0.1;     ///< m, > 0, along the intrados of the first bed
  int shift = 0;  ///< letters by which the drawing moves along where it is repeated above itself
  Length length = Length::narrowing;
  std::optional<double> phase =
      {};  ///< letters from the first corner, or the end of a wall, to the drawing; none: 1/2 on
           ///< a vault with corners, so that no joint lies on a corner, else 0
  std::vector<std::pair<char, LetterKind>> kinds = {};  ///< of letters; others are by_shape
  int refine = 1;                                       ///< >= 1

  char letter(int column, int row) const;  ///< of a cell of the infinite pattern
  LetterKind kind_of(char letter) const;
};
constexpr auto enum_names(DrawnBond::LetterKind) {
  return std::array{"by_shape", "flat", "upright"};
}
constexpr auto enum_names(DrawnBond::Length) {
  return std::array{"narrowing", "constant"};
}

using Bond = std::variant<RunningBond, StackBond, HerringboneBond, FillBond, DrawnBond>;

}  // namespace cupola
