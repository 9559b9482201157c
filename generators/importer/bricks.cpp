#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "generators/importer/readers.hpp"
#include "generators/importer/text_lines.hpp"

namespace cupola {
namespace {

// Columns before it: ID, fixed, visible, yielding, density, force (3) and reference point (3).
constexpr size_t kFirstForce = 5, kFirstCoordinate = 11;
constexpr double kPartSeparator = 9999.0;

/// A number, or a message with the words before it.
double expect_number(const TextLines& lines, size_t word) {
  std::string before;
  for (size_t w = word - std::min<size_t>(word, 3); w < word; ++w)
    before += fmt::format(" {}", lines.words()[w]);
  return lines.number(word, fmt::format(" (value {} of the row, after{})", word + 1, before));
}

/// The corners of the convex parts in a row, separated by 9999.
std::vector<std::vector<Vec3>> read_parts(const TextLines& lines) {
  std::vector<std::vector<Vec3>> parts;
  std::vector<double> numbers;
  const size_t num_words = lines.words().size();
  const auto close = [&](size_t end) {
    if (numbers.size() % 3 != 0)
      lines.fail(
          fmt::format("part {} has {} up to value {} of the row, '{}'; a corner has three, x y z: look for a "
                      "stray or a missing number",
                      parts.size() + 1, counted(numbers.size(), "number"), end, lines.words()[end - 1]));
    std::vector<Vec3>& part = parts.emplace_back();
    for (size_t i = 0; i < numbers.size(); i += 3)
      part.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    numbers.clear();
  };
  for (size_t w = kFirstCoordinate; w < num_words; ++w) {
    const double number = expect_number(lines, w);
    if (number == kPartSeparator)
      close(w);
    else
      numbers.push_back(number);
  }
  close(num_words);
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

RawTie tie_of_row(const TextLines& lines, size_t num_words) {
  if (lines.words().size() < num_words)
    lines.fail(fmt::format("the row has {}, at least {} are required", counted(lines.words().size(), "value"),
                           num_words));
  RawTie tie;
  tie.where = lines.where();
  tie.block_a = lines.words()[1];
  tie.point_a = lines.point(2);
  tie.block_b = lines.words()[5];
  tie.point_b = lines.point(6);
  return tie;
}

}  // namespace

std::vector<RawBlock> read_bricks(const std::string& path) {
  TextLines lines(path, ",;");
  std::vector<RawBlock> blocks;
  while (lines.next()) {
    const size_t num_words = lines.words().size();
    lines.enter(fmt::format("block {}", lines.words()[0]));
    if (lines.words()[0].empty()) lines.fail("the first column, its ID, is empty");
    if (num_words < kFirstCoordinate)
      lines.fail(fmt::format("the row has {}, at least {} are required", counted(num_words, "value"),
                             kFirstCoordinate));
    RawBlock block{std::string(lines.words()[0]), lines.where(), {}, {}, expect_number(lines, 1) != 0.0, {}};
    block.density = expect_number(lines, 4);
    if (*block.density <= 0.0) lines.fail(fmt::format("density = {}: must be > 0", *block.density));
    for (size_t w = kFirstForce; w < kFirstForce + 3; ++w)
      if (expect_number(lines, w) != 0.0)
        lines.fail("has a force, which is not read: give it as loads.forces, and 0, 0, 0 in the table");
    block.point_parts = read_parts(lines);
    if (block.point_parts.empty()) lines.fail("no corners");
    blocks.push_back(std::move(block));
  }
  if (blocks.empty()) throw InputError(FileLocation{path}, "no blocks in this file");
  return blocks;
}

std::vector<RawTie> read_springs(const std::string& path) {
  TextLines lines(path, ",;");
  std::vector<RawTie> ties;
  while (lines.next()) {
    RawTie tie = tie_of_row(lines, 11);
    tie.stiffness = lines.number(9);
    tie.length = lines.number(10);
    if (tie.stiffness <= 0.0 || tie.length <= 0.0)
      lines.fail(
          fmt::format("k = {}, L0 = {}: a spring requires k > 0 and L0 > 0", tie.stiffness, tie.length));
    ties.push_back(tie);
  }
  return ties;
}

std::vector<RawTie> read_rods(const std::string& path) {
  TextLines lines(path, ",;");
  std::vector<RawTie> ties;
  while (lines.next()) {
    RawTie tie = tie_of_row(lines, 9);
    tie.stiffness = std::numeric_limits<double>::infinity();
    tie.length = (tie.point_b - tie.point_a).norm();
    tie.pushes = true;
    ties.push_back(tie);
  }
  return ties;
}

}  // namespace cupola
