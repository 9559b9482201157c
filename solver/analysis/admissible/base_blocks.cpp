#include "solver/analysis/admissible/base_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

/// Of each sail, the blocks whose centroids lie nearest its middle. None on a surface without ribs.
std::set<int> mid_sails(const Assembly& assembly, const std::set<int>& base) {
  constexpr double kSame = 1e-6;  // rounding of a position across the sail
  std::map<int, double> nearest;
  bool ribs = false;
  for (const int block : base) {
    const Block& b = assembly.blocks[block];
    ribs = ribs || b.rib;
    const auto entry = nearest.try_emplace(b.sail, std::numeric_limits<double>::infinity()).first;
    entry->second = std::min(entry->second, std::abs(b.sail_position));
  }
  std::set<int> blocks;
  for (const int block : base) {
    const Block& b = assembly.blocks[block];
    if (ribs && std::abs(b.sail_position) <= nearest.at(b.sail) + kSame) blocks.insert(block);
  }
  return blocks;
}

std::set<int> listed(const Assembly& assembly, const std::set<int>& base,
                     const std::vector<BlockRef>& blocks) {
  std::set<int> numbers;
  for (const BlockRef& block : blocks) {
    check_block(assembly, block);
    if (!base.contains(block))
      throw InputError(
          fmt::format("analysis.range.quantities: block {} rests on no support; the blocks that do: {}",
                      block_label(assembly, block), block_labels(assembly, {base.begin(), base.end()})));
    numbers.insert(block);
  }
  return numbers;
}

}  // namespace

void check_block(const Assembly& assembly, int block) {
  check_block_exists(assembly, block, "analysis.range.quantities");
}

std::set<int> blocks_on_supports(const Assembly& assembly, const JointGeometry& joints) {
  const auto fixed = [&](int block) { return assembly.blocks[block].fixed; };
  std::set<int> blocks;
  for (const auto& [key, pair] : joints.pairs())
    if (fixed(key.first) != fixed(key.second)) blocks.insert(fixed(key.first) ? key.second : key.first);
  return blocks;
}

std::set<int> blocks_on_supports(const Assembly& assembly, const JointGeometry& joints,
                                 const BaseBlocks& group) {
  using enum BaseBlocks::Group;
  const std::set<int> base = blocks_on_supports(assembly, joints);
  std::set<int> blocks;
  if (group.group == BaseBlocks::Group::listed) blocks = cupola::listed(assembly, base, group.blocks);
  if (group.group == BaseBlocks::Group::mid_sails) blocks = cupola::mid_sails(assembly, base);
  for (const int block : base) {
    const Block& b = assembly.blocks[block];
    if ((group.group == ribs && b.rib) || (group.group == herringbone && b.kind == BlockKind::herringbone))
      blocks.insert(block);
  }
  if (blocks.empty())
    throw InputError(fmt::format("analysis.range.quantities: {}: no block of the group rests on a support",
                                 to_string(group.group)));
  return blocks;
}

}  // namespace cupola
