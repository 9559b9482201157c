#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

// Bound on the grid, so that a typing error gives a message rather than exhausts memory. The largest study of
// the project has 1.3 million cells.
constexpr double kMostCells = 2e7;

void declare_grid(Section& s, int& rings, int& blocks_per_ring, int& refine) {
  s.integer("rings", rings, {.min = 1, .max = kMostRings},
            "number of rings of a dome, courses of a wall, or voussoirs of an arch");
  s.integer("blocks_per_ring", blocks_per_ring, {.min = 1, .max = kMostCells},
            "number of whole blocks in each ring; at least 3 on a closed ring");
  s.integer(
      "refine", refine, {.min = 1, .max = 1000},
      "split each course into this many courses and each block into this many blocks, in the same bond");
}

/// `slices`: cells per whole block along the ring.
template <class SomeBond>
void check_cells(const Section& s, const SomeBond& bond, double slices) {
  const double courses = 1.0 * bond.rings * bond.refine;
  s.rule(courses <= kMostRings, "refine", "rings x refine must be <= 1e5; reduce one of them");
  s.rule(courses * bond.blocks_per_ring * bond.refine * slices <= kMostCells, "blocks_per_ring",
         "rings x blocks_per_ring x slices x refine^2 must be <= 2e7 cells; reduce one of them");
}

constexpr const char* kPhase = "block widths from the first corner to the first head joint or spiral";
constexpr const char* kNoPhase = "joints avoid corners";

void declare_running_bond(Section& s, RunningBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 2, .max = 64},
            "convex cells per block along the ring; an even number");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  s.rule(bond.slices_per_block % 2 == 0, "slices_per_block",
         "must be even, because odd rings are shifted by half a block");
  check_cells(s, bond, bond.slices_per_block);
}

void declare_stack_bond(Section& s, StackBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 1, .max = 64},
            "convex cells per block along the ring");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  check_cells(s, bond, bond.slices_per_block);
}

void declare_herringbone_bond(Section& s, HerringboneBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("spirals", bond.spirals, {.min = 1, .max = kMostRings},
            "number of spirals, or of meridian strips");
  s.integer("rings_per_vertical", bond.rings_per_vertical, {.min = 1, .max = 1000},
            "height of an upright block, in rings");
  s.integer("verticals_per_block", bond.verticals_per_block, {.min = 1, .max = 1000},
            "width of a whole block over the width of an upright block");
  s.choice("path", bond.path, "upright blocks climb in spirals or straight up the meridians");
  s.choice(
      "chirality", bond.chirality,
      "right: spirals climb counter-clockwise, seen from above; both: spirals of either hand, which cross");
  s.integer(
      "embedment", bond.embedment, {.min = -1},
      "courses by which the uprights in the last course built stand in the courses below, one upright per "
      "spiral and course; -1: a new one in each course, so that uprights of every embedment stand side by "
      "side");
  s.rule(bond.embedment < bond.rings_per_vertical, "embedment", "must be < rings_per_vertical");
  s.rule(bond.embedment < 0 || bond.refine == 1, "embedment", "requires refine: 1");
  s.choice("beside", bond.beside,
           "head joints of the flat blocks: step with the spirals, keep a half bond, or lie on meridians");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  s.integer("slices_per_vertical", bond.slices_per_vertical, {.min = 1, .max = 64},
            "convex cells per upright block along the ring");
  s.rule(bond.beside != HerringboneBond::Beside::half ||
             bond.verticals_per_block * bond.slices_per_vertical % 2 == 0,
         "beside",
         "half requires an even number of slices per block; change verticals_per_block or "
         "slices_per_vertical so that their product is even");
  check_cells(s, bond, 1.0 * bond.verticals_per_block * bond.slices_per_vertical);
}

void declare_fill_bond(Section& s, FillBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 1, .max = 64},
            "number of positions per mean block width where a head joint may lie");
  s.number("narrowest", bond.narrowest, {.above = 0, .max = 1},
           "width of the narrowest block over the mean width");
  s.number("widest", bond.widest, {.min = 1, .max = 10}, "width of the widest block over the mean width");
  check_cells(s, bond, bond.slices_per_block);
}

/// The letters of the drawing are the keys.
void declare_kinds(Section& s, DrawnBond& bond) {
  std::set<char> letters;
  for (const std::string& row : bond.rows) letters.insert(row.begin(), row.end());
  letters.erase('.');
  for (const char letter : letters) {
    auto kind = DrawnBond::LetterKind::by_shape;
    s.choice(std::string(1, letter), kind, "kind of its blocks");
    if (kind != DrawnBond::LetterKind::by_shape) bond.kinds.emplace_back(letter, kind);
  }
}

void declare_drawn_bond(Section& s, DrawnBond& bond) {
  s.integer("rings", bond.rings, {.min = 1, .max = kMostRings}, "number of courses");
  s.texts("rows", bond.rows,
          "the drawing, seen from outside, the uppermost course first: cells of one letter that touch form a "
          "block, a point is empty");
  s.required_number("letter_length", bond.letter_length, {.unit = "m", .above = 0},
                    "length of a letter along the first bed, on the intrados");
  s.choice(
      "length", bond.length,
      "of a letter in courses that shorten: it narrows with them, or is constant, so that each course has "
      "a number of its own and begins anew at `phase`");
  s.integer("shift", bond.shift, {.min = -100000, .max = 100000},
            "letters by which the drawing moves along where it is repeated above itself");
  s.optional_number("phase", bond.phase, {.min = 0, .max = 100000}, kNoPhase,
                    "letters from the first corner, or the end of a wall, to the drawing");
  s.integer(
      "refine", bond.refine, {.min = 1, .max = 1000},
      "split each course into this many courses and each block into this many blocks, in the same bond");
  s.rule(!bond.rows.empty() && !bond.rows.front().empty(), "rows",
         "is missing: give the rows of the drawing, for example [aaaabbbb, ccddddcc]");
  size_t cells = 0;
  for (size_t i = 0; i < bond.rows.size(); ++i) {
    const std::string& row = bond.rows[i];
    cells += row.size();
    s.rule(row.size() == bond.rows.front().size(), "rows",
           fmt::format("all rows must have the same number of letters: row {} has {}, the first {}", i,
                       row.size(), bond.rows.front().size()));
    s.rule(std::ranges::all_of(row, [](char c) { return c > ' ' && c <= '~'; }), "rows",
           fmt::format("row {} has a blank or a letter outside ASCII", i));
  }
  s.rule(cells <= kMostCells / 20, "rows", "a drawing has at most 1e6 letters");
  s.section("kinds", bond,
            "LETTER: flat or upright, the joints and colours of its blocks; by_shape: upright if taller than "
            "wide",
            declare_kinds);
}

}  // namespace

void declare_bond(Section& s, Bond& bond) {
  s.variant<Bond>(
      "type", bond,
      {alternative<Bond>("running", "running bond: odd rings shifted by half a block", declare_running_bond),
       alternative<Bond>("stack", "stack bond: head joints aligned", declare_stack_bond),
       alternative<Bond>("herringbone",
                         "herringbone bond: upright blocks climb through whole blocks laid flat",
                         declare_herringbone_bond),
       alternative<Bond>("fill", "blocks of unequal width whose head joints avoid those of the ring below",
                         declare_fill_bond),
       alternative<Bond>("drawn", "a bond drawn in letters, repeated over the surface", declare_drawn_bond)},
      "how the shell is cut into blocks");
}

}  // namespace cupola
