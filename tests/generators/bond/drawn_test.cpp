#include "generators/bond/drawn.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/bond/courses.hpp"
#include "generators/bond/drawing.hpp"
#include "generators/bond/long_blocks.hpp"
#include "generators/bond/wythe_bond.hpp"
#include "generators/generate.hpp"
#include "tests/generators/models.hpp"
#include "tests/test_names.hpp"

namespace cupola::drawn_test {
namespace {

using Rows = std::vector<std::string>;

DrawnBond drawn(Rows rows, int shift = 0) {
  DrawnBond bond;
  bond.rows = std::move(rows);
  bond.letter_length = 0.1;
  bond.shift = shift;
  return bond;
}

/// A wall of so many letters and courses of 0.1 m.
BondGrid wall(int letters, int courses) {
  BondGrid grid{courses, false, 0.1 * letters, {}};
  grid.length = 0.1 * letters;
  grid.thickness = 0.1;
  return grid;
}

BondGrid ring(int letters, int courses) {
  BondGrid grid = wall(letters, courses);
  grid.closed = true;
  grid.extent = 2 * std::numbers::pi;
  return grid;
}

std::string error_of(const DrawnBond& bond, const BondGrid& grid) {
  try {
    drawn_bond(bond, grid);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct GalleryBond {
  Rows rows;
  int shift, blocks, truncated, uprights;
};

class Gallery : public testing::TestWithParam<GalleryBond> {};

// Counted by hand on a wall of 24 letters and 6 courses.
TEST_P(Gallery, HasTheBlocksCountedByHand) {
  const BondPattern bond = drawn_bond(drawn(GetParam().rows, GetParam().shift), wall(24, 6));
  EXPECT_EQ(bond.blocks.size(), static_cast<size_t>(GetParam().blocks));
  EXPECT_EQ(std::ranges::count_if(bond.blocks, [](const BondBlock& b) { return b.truncated; }),
            GetParam().truncated);
  EXPECT_EQ(
      std::ranges::count_if(bond.blocks, [](const BondBlock& b) { return b.kind == BlockKind::herringbone; }),
      GetParam().uprights);
}

// Stretcher: 3 courses of 6, 3 of 5 and two halves. Stack: 6 of 6. Header course over stretchers, English: 3
// of 6, 3 of 11 and two halves. Flemish: 4 stretchers and 4 headers a course; every other course begins and
// ends with parts of a stretcher, of 1 and 3 letters of 4. Monk: lowest course 4 4 2 4 4 2 4 letters, the one
// above it 3 2 4 4 2 4 4 1, whose first and last are cut. Basket: 3 periods of 8 and the lower halves of 3
// more. Pinwheel: 4 by 2 periods of 5. Herringbone: 9 flat blocks in even courses, 3 4 3 in odd ones, whose
// first and last in course 3 are cut; uprights: 9 c, and e in courses 0 (cut), 1 to 2, 3 to 4 and 5 (cut), 3
// each. One spiral: 6 uprights in each period of 3 courses; beside them 6 flat blocks a course, and where the
// drawing has moved by one letter 5 and pieces of 1 and 2 letters of 3. Two spirals in 8 letters, which move
// by 2 letters every 2 courses: 6 uprights a period; 6 flat blocks a course, in the second period 5 and
// pieces of 2 and 1. Groin vaults: along, 12 stones in even courses, 11 and two halves in odd ones. Across,
// 12 columns of 3 whole stones, and 12 of 2 between the halves of 2. Diagonal, 6 flat stones a course, but 5
// and two halves in course 3; 18 uprights y, 6 in each 2 courses; x in courses 0 (cut), 1 to 2, 3 to 4 and 5
// (cut), 6 each.
INSTANTIATE_TEST_SUITE_P(
    Bonds, Gallery,
    testing::Values(GalleryBond{{"ccddddcc", "aaaabbbb"}, 0, 18 + 21, 6, 0},
                    GalleryBond{{"ccccdddd", "aaaabbbb"}, 0, 36, 0, 0},
                    GalleryBond{{"haabbcch", "ddddeeee"}, 0, 18 + 39, 6, 0},
                    GalleryBond{{"dccddd", "aaaabb"}, 0, 24 + 27, 6, 0},
                    GalleryBond{{"eeeffgggge", "aaaabbbbcc"}, 0, 3 * 7 + 3 * 8, 6, 0},
                    GalleryBond{{"aaaaccdd", "bbbbccdd", "eeffgggg", "eeffhhhh"}, 0, 3 * 4 + 6 * 4, 0, 0},
                    GalleryBond{{"aaaabb", "ddccbb", "ddeeee"}, 0, 4 * 2 * 5, 0, 0},
                    GalleryBond{{"eeddddcc", "aaaaeecc"}, 4, 9 + 10 + 9 + 12, 8, 0},
                    GalleryBond{{"addd", "accc", "abbb"}, 1, 12 + 18 + 21, 6, 12},
                    GalleryBond{{"abbbcddd", "aeeecfff"}, 2, 18 + 12 + 14 + 12, 4, 18},
                    GalleryBond{{"cddc", "aabb"}, 0, 36 + 39, 6, 0},
                    GalleryBond{{"ad", "ac", "bc", "bd"}, 0, 36 + 48, 24, 84},
                    GalleryBond{{"xbby", "aaxy"}, 2, 37 + 18 + 24, 14, 42}),
    test_names({"stretcher", "stack", "english", "flemish", "monk", "basket", "pinwheel", "herringbone",
                "spiral", "two_spirals", "groin_along", "groin_across", "groin_diagonal"}));

TEST(Drawn, IsTheRunningBondOfTheSameBlocks) {
  const BondGrid grid = wall(24, 6);
  const BondPattern drawing = drawn_bond(drawn({"ccddddcc", "aaaabbbb"}), grid);
  const BondPattern running =
      running_bond(RunningBond{.rings = 6, .blocks_per_ring = 6, .slices_per_block = 4}, grid);
  ASSERT_EQ(drawing.num_slices(), running.num_slices());
  for (int s = 0; s <= running.num_slices(); ++s) EXPECT_NEAR(drawing.cuts[s], running.cuts[s], 1e-14);
  EXPECT_EQ(drawing.block_of, running.block_of);
}

TEST(Drawn, ASpiralClimbsByItsShift) {
  // An upright of 3 courses and one letter, moved by one letter every 3 courses, beside flat blocks of 3
  // letters.
  const BondPattern spiral = drawn_bond(drawn({"addd", "accc", "abbb"}, 1), ring(16, 9));
  int uprights = 0;
  for (const BondBlock& block : spiral.blocks) uprights += block.kind == BlockKind::herringbone ? 1 : 0;
  EXPECT_EQ(uprights, 4 * 3);
  for (int r = 0; r < 9; ++r)
    for (int s = 0; s < 16; ++s)
      EXPECT_EQ(spiral.blocks[spiral.at(r, s)].kind == BlockKind::herringbone, (s - r / 3) % 4 == 0);
}

TEST(Drawn, KindsOfLettersComeBeforeTheirShape) {
  DrawnBond bond = drawn({"ad", "ac", "bc", "bd"});  // all blocks are taller than wide
  bond.kinds = {{'a', DrawnBond::LetterKind::flat}, {'d', DrawnBond::LetterKind::upright}};
  for (const BondBlock& block : drawn_bond(bond, wall(8, 8)).blocks)
    EXPECT_EQ(block.kind == BlockKind::herringbone, block.letter != 'a') << block.letter;
}

TEST(Drawn, EqualLettersApartAreTwoBlocksAndAPointIsEmpty) {
  const BondPattern bond = drawn_bond(drawn({"cc.c", "aa.a"}), wall(4, 1));
  EXPECT_EQ(bond.block_of, (std::vector<int>{0, 0, kVoid, 1}));
}

TEST(Drawn, KeepsAnLInOnePiece) {
  Case scene;
  scene.geometry.surface = WallSurface{0.6, 0.2, 0.1};
  DrawnBond bond = drawn({"cdd", "ccd", "abb", "aab"});
  bond.rings = 2;
  scene.geometry.bond = bond;
  ModelReport report;
  const Assembly assembly = check_and_report(scene, &report);
  ASSERT_EQ(report.num_blocks, 4);
  for (const Block& block : assembly.blocks)
    EXPECT_TRUE(block.fixed || std::abs(block.volume - 3 * 0.1 * 0.1 * 0.1) < 1e-15) << "three cells";
}

TEST(Drawn, JoinsANarrowEndToItsNeighbour) {
  const BondPattern bond = drawn_bond(drawn({"cccccddddd", "aaaaabbbbb"}), wall(6, 1));
  EXPECT_EQ(bond.block_of, (std::vector<int>(6, 0))) << "one letter of five";
  EXPECT_EQ(drawn_bond(drawn({"ccccdddd", "aaaabbbb"}), wall(5, 1)).blocks.size(), 2u)
      << "one letter of four";
}

// An L of five letters and one above: a wall of four letters keeps five of them. One letter of six, in two
// courses, joins its neighbours.
TEST(Drawn, MeasuresTheEndsOfAnLOverAllItsCourses) {
  EXPECT_EQ(drawn_bond(drawn({"gggggh", "accccd", "aaaaab"}), wall(4, 3)).block_of,
            (std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(drawn_bond(drawn({"gggggggh", "aaadddcc", "aaaaaabb"}), wall(9, 2)).block_of,
            (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 2, 2, 2, 3, 3, 3}));
}

TEST(Drawn, RefinesBlocksInTheSameBond) {
  DrawnBond bond = drawn({"ccddddcc", "aaaabbbb"});
  bond.refine = 2;
  BondGrid grid = wall(24, 12);
  grid.thickness = 0.05;
  const BondPattern fine = drawn_bond(bond, grid);
  EXPECT_EQ(fine.blocks.size(), 6u * 12 + 6 * 13);
  EXPECT_EQ(fine.num_slices(), 48);
}

TEST(Drawn, NamesALetterWithoutEnd) {
  EXPECT_NE(error_of(drawn({"aabb", "aacc"}), wall(8, 4)).find("the letter a goes on without end"),
            std::string::npos);
  EXPECT_NE(error_of(drawn({"bba"}, 1), wall(8, 4)).find("the letter b goes on without end"),
            std::string::npos);
  EXPECT_NE(error_of(drawn({"aaaa"}), wall(8, 4)).find("the letter a"), std::string::npos);
  EXPECT_EQ(error_of(drawn({"ab"}, 1), wall(8, 4)), "") << "a touches a only across an edge";
}

TEST(Drawn, RingsTakeWholeDrawings) {
  EXPECT_EQ(drawn_bond(drawn({"ccdd", "aabb"}), ring(24, 2)).blocks.size(), 24u);
  EXPECT_NE(error_of(drawn({"ccccdddd", "aaaabbbb"}), ring(28, 2))
                .find("takes 4 drawings of 8 letters, of 0.0875 m each"),
            std::string::npos)
      << error_of(drawn({"ccccdddd", "aaaabbbb"}), ring(28, 2));
  EXPECT_NE(error_of(drawn({"aaaaaaaa."}), ring(9, 2)), "") << "shift 0: a goes up without end";
  DrawnBond half = drawn({"ab"}, 1);
  half.phase = 0.5;
  EXPECT_NEAR(drawn_bond(half, ring(8, 1)).cuts.front(), 2 * std::numbers::pi / 16, 1e-15);
  EXPECT_NE(error_of(half, wall(8, 1)).find("whole number of letters on an open surface"), std::string::npos);
}

// Long blocks fill the empty cells of their course, and those of the others stay empty.
TEST(Drawn, LongBlocksLeaveTheEmptyCellsOfOtherCourses) {
  const BondGrid grid = ring(24, 4);
  BondPattern bond = drawn_bond(drawn({"ccd.", "aab."}), grid);
  lay_long_blocks(grid, 1, 1, 6, "geometry.chains[0]", &bond);
  EXPECT_EQ(bond.blocks.size(), 6u + 3 * 12);
  for (int course = 0; course < 4; ++course)
    for (int slice = 0; slice < 24; ++slice)
      EXPECT_EQ(bond.at(course, slice) == kVoid, course != 1 && slice % 4 == 3) << course << " " << slice;
}

/// Wythes of one thickness, inside first.
Masonry wythes(const std::vector<Rows>& drawings) {
  Masonry masonry;
  for (const Rows& rows : drawings) {
    Wythe wythe;
    wythe.name = std::string(1, static_cast<char>('p' + masonry.wythes.size()));
    DrawnBond bond = drawn(rows);
    bond.rings = 4;
    wythe.bond = bond;
    masonry.wythes.push_back(wythe);
  }
  return masonry;
}

// English bond over 16 letters and 4 courses: 2 courses of 2 x 4 stretchers, 2 of 7 headers and two halves.
TEST(DrawnWythes, ShareHeaders) {
  const Masonry english = wythes({{"heeffggh", "aaaabbbb"}, {"heeffggh", "ccccdddd"}});
  const BondPattern bond = make_wythe_bond(english, wall(16, 4), {0.05, 0.15, 0.25, 0.35});
  EXPECT_EQ(member_names(english), (std::vector<std::string>{"p", "q", "headers"}));
  EXPECT_EQ(bond.blocks.size(), 2u * 8 + 2 * 9);
  EXPECT_EQ(std::ranges::count_if(bond.blocks, [](const BondBlock& b) { return b.member == 2; }), 2 * 9);
  EXPECT_EQ(member_names(wythes({{"ba", "ab"}, {"dc", "cd"}})).size(), 2u) << "nothing in common";
}

// The same wall as wythes of running bond and bonders: the cuts are the same, and two cells belong to one
// block in both or in neither.
TEST(DrawnWythes, AreTheEnglishBondOfBonders) {
  Masonry masonry;
  for (const char* name : {"p", "q"}) {
    Wythe wythe;
    wythe.name = name;
    wythe.bond = RunningBond{.rings = 4, .blocks_per_ring = 4, .slices_per_block = 2};
    masonry.wythes.push_back(wythe);
  }
  Bonders headers;
  headers.name = "header";
  headers.from = "p";
  headers.to = "q";
  headers.per_ring = 8;
  headers.at = {0.0};
  headers.every = 2;
  headers.first = 1;
  masonry.bonders = {headers};
  const std::vector<double> heights{0.05, 0.15, 0.25, 0.35};
  const BondPattern laid = make_wythe_bond(masonry, wall(16, 4), heights);
  const BondPattern bond =
      make_wythe_bond(wythes({{"heeffggh", "aaaabbbb"}, {"heeffggh", "ccccdddd"}}), wall(16, 4), heights);
  ASSERT_EQ(bond.num_slices(), laid.num_slices());
  ASSERT_EQ(bond.blocks.size(), laid.blocks.size());
  std::map<int, int> same;
  for (size_t cell = 0; cell < bond.block_of.size(); ++cell)
    EXPECT_EQ(same.try_emplace(bond.block_of[cell], laid.block_of[cell]).first->second, laid.block_of[cell]);
}

TEST(DrawnWythes, KeepTheirEmptyCells) {
  const BondPattern bond =
      make_wythe_bond(wythes({{"c.dd", "aabb"}, {"eef.", "gghh"}}), wall(16, 4), {0, 1, 2, 3});
  EXPECT_EQ(bond.num_slices(), 16);
  for (int ring = 0; ring < 4; ++ring)
    for (int slice = 0; slice < 16; ++slice)
      for (int wythe = 0; wythe < 2; ++wythe)
        EXPECT_EQ(bond.at(ring, slice, wythe) == kVoid, ring % 2 == 1 && slice % 4 == (wythe == 0 ? 1 : 3))
            << ring << " " << slice << " " << wythe;
}

TEST(DrawnWythes, LeaveTheNameOfTheirHeaders) {
  Masonry english = wythes({{"heeffggh", "aaaabbbb"}, {"heeffggh", "ccccdddd"}});
  english.wythes[0].name = "headers";
  try {
    member_names(english);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("geometry.wythes: no wythe can be called headers"),
              std::string::npos)
        << error.what();
  }
}

TEST(DrawnWythes, AreRefusedIfALetterGoesOnThroughThem) {
  // x steps from wythe to wythe and along, without end.
  EXPECT_THROW(make_wythe_bond(wythes({{"dddc", "xxxa"}, {"hihh", "xbxx"}}), wall(16, 4), {0, 1, 2, 3}),
               InputError);
  EXPECT_THROW(make_wythe_bond(wythes({{"ccdd", "aabb"}, {"dcc", "baa"}}), wall(12, 4), {0, 1, 2, 3}),
               InputError);
}

// A header is one block because its letters lie side by side; without headers, wythes may differ.
TEST(DrawnWythes, ThatShareALetterHaveEqualLettersAndCourses) {
  const std::vector<std::function<void(DrawnBond*)>> changes{
      [](DrawnBond* b) { b->letter_length = 0.05; }, [](DrawnBond* b) { b->phase = 2.0; },
      [](DrawnBond* b) { b->rings = 2; }, [](DrawnBond* b) { b->refine = 2; },
      [](DrawnBond* b) { b->length = DrawnBond::Length::constant; }};
  for (size_t i = 0; i < changes.size(); ++i) {
    Masonry english = wythes({{"heeffggh", "aaaabbbb"}, {"heeffggh", "ccccdddd"}});
    changes[i](&std::get<DrawnBond>(*english.wythes[1].bond));
    try {
      member_names(english);
      ADD_FAILURE() << i;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("the letter h is in two wythes"), std::string::npos)
          << error.what();
    }
    Masonry apart = wythes({{"ba", "ab"}, {"dc", "cd"}});
    changes[i](&std::get<DrawnBond>(*apart.wythes[1].bond));
    EXPECT_EQ(member_names(apart).size(), 2u) << i;
  }
}

// What a drawing means, checked cell by cell: neighbours of one letter belong to one block, others do not; a
// block is connected, because its cells were reached from its first.
TEST(Drawn, RandomDrawingsGiveBlocksOrNameALetter) {
  std::mt19937 random(1);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int laid = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Rows rows(static_cast<size_t>(1 + below(4)));
    const int columns = 2 + below(7), letters = 2 + below(5);
    for (std::string& row : rows)
      for (int c = 0; c < columns; ++c) row += "abcdef."[below(letters + (below(9) == 0 ? 1 : 0))];
    const DrawnBond bond = drawn(rows, below(5) - 2);
    const bool closed = below(2) == 0;
    const BondGrid grid = closed ? ring(columns * 4, 9) : wall(17, 9);
    const std::string error = error_of(bond, grid);
    if (!error.empty()) {
      std::smatch named;
      ASSERT_TRUE(std::regex_search(error, named, std::regex("(the letter|of [0-9]+ letters) ([a-f]) ")))
          << error;
      EXPECT_TRUE(std::ranges::any_of(rows, [&](const std::string& row) {
        return row.find(named[2].str()) != std::string::npos;
      })) << error;
      continue;
    }
    ++laid;
    const BondPattern pattern = drawn_bond(bond, grid);
    std::set<int> used;
    for (int r = 0; r < 9; ++r)
      for (int s = 0; s < pattern.num_slices(); ++s) {
        const int block = pattern.at(r, s);
        EXPECT_EQ(block == kVoid, bond.letter(s, r) == '.');
        used.insert(block);
        const int right = s + 1 < pattern.num_slices() ? s + 1 : closed ? 0 : -1;
        const bool at_end = !closed && (s < 2 || s + 3 > pattern.num_slices());  // ends may be joined
        if (at_end || block == kVoid) continue;
        const auto agrees = [&](int other, int column, int row) {
          return (other == block) == (bond.letter(s, r) == bond.letter(column, row));
        };
        EXPECT_TRUE(right < 0 || agrees(pattern.at(r, right), s + 1, r));
        EXPECT_TRUE(r + 1 == 9 || agrees(pattern.at(r + 1, s), s, r + 1));
      }
    used.erase(kVoid);
    EXPECT_EQ(used.size(), pattern.blocks.size()) << "every block has a cell";
  }
  EXPECT_GT(laid, 50);
}

}  // namespace
}  // namespace cupola::drawn_test
