#include <limits>
#include <map>

#include <fmt/format.h>

#include "generators/importer/readers.hpp"
#include "generators/importer/text_lines.hpp"

namespace cupola {
namespace {

// Columns before it: ID, fixed, visible, yielding, density, force (3) and reference point (3).
constexpr size_t kFirstCoordinate = 11;
constexpr double kPartSeparator = 9999.0;

RawTie tie_of_row(const TextLines& lines, size_t num_words) {
  if (lines.words().size() < num_words)
    lines.fail(
        fmt::format("the row has {} values, at least {} are required", lines.words().size(), num_words));
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
    if (num_words < kFirstCoordinate)
      lines.fail(fmt::format("the row has {} values, at least {} are required", num_words, kFirstCoordinate));
    RawBlock block{std::string(lines.words()[0]), lines.where(), {}, {{}}, lines.number(1) != 0.0, {}};
    block.density = lines.number(4);
    if (*block.density <= 0.0) lines.fail(fmt::format("density = {}: must be > 0", *block.density));
    size_t w = kFirstCoordinate;
    while (w < num_words) {
      if (lines.number(w) == kPartSeparator) {
        block.point_parts.emplace_back();
        ++w;
      } else {
        block.point_parts.back().push_back(lines.point(w));
        w += 3;
      }
    }
    std::erase_if(block.point_parts, [](const auto& part) { return part.empty(); });
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
    if (tie.stiffness <= 0.0 || tie.length < 0.0)
      lines.fail(
          fmt::format("k = {}, L0 = {}: a spring requires k > 0 and L0 >= 0", tie.stiffness, tie.length));
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
