#include "assembly/model/block_names.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {

std::string block_label(const Assembly& assembly, int block) {
  const std::string& name = assembly.blocks.at(static_cast<size_t>(block)).name;
  return name.empty() ? std::to_string(block) : name;
}

std::string block_labels(const Assembly& assembly, const std::vector<int>& blocks) {
  constexpr size_t kMost = 8;
  std::string text;
  for (size_t i = 0; i < std::min(blocks.size(), kMost); ++i)
    text += (i ? ", " : "") + block_label(assembly, blocks[i]);
  return blocks.size() > kMost ? text + ", ..." : text;
}

namespace {

/// Replaces names of blocks by their numbers.
class BlockNames {
 public:
  explicit BlockNames(const Assembly& assembly) : assembly_(assembly) {
    int supports = 0;
    for (size_t b = 0; b < assembly.blocks.size(); ++b) {
      std::string name = assembly.blocks[b].name;
      named_by_file_ = named_by_file_ || !name.empty();
      if (name.empty() && assembly.blocks[b].fixed) name = fmt::format("support {}", supports++);
      if (name.empty()) continue;
      number_of_[name] = static_cast<int>(b);
      names_.push_back(name);
    }
  }

  /// `key` of the case is for the message.
  void resolve(const std::string& key, BlockRef* block) const {
    if (block->name.empty()) return check_block_exists(assembly_, *block, key);
    const auto found = number_of_.find(block->name);
    if (found == number_of_.end()) {
      const std::string near = nearest_name(block->name, names_);
      throw InputError(fmt::format(
          "{}: no block is named '{}'{}", key, block->name,
          !near.empty()    ? fmt::format("; did you mean '{}'?", near)
          : named_by_file_ ? fmt::format("; the first block is '{}'", names_.front())
                           : "; generated blocks have numbers, and supports the names 'support 0', "
                             "'support 1', ..."));
    }
    *block = found->second;
  }

 private:
  const Assembly& assembly_;
  bool named_by_file_ = false;
  std::map<std::string, int> number_of_;
  std::vector<std::string> names_;
};

std::vector<BlockRef*> pointers_to(std::vector<BlockRef>* blocks) {
  std::vector<BlockRef*> pointers;
  for (BlockRef& block : *blocks) pointers.push_back(&block);
  return pointers;
}

/// The blocks that a quantity names.
std::vector<BlockRef*> blocks_of(ForceQuantity* quantity) {
  std::vector<BlockRef*> blocks;
  const auto add_group = [&blocks](BaseBlocks* group) {
    std::ranges::copy(pointers_to(&group->blocks), std::back_inserter(blocks));
  };
  if (auto* reaction = std::get_if<BlockReaction>(quantity)) blocks.push_back(&reaction->block);
  if (auto* joint = std::get_if<JointForce>(quantity)) blocks = {&joint->block_a, &joint->block_b};
  if (auto* share = std::get_if<BaseShare>(quantity)) add_group(&share->of);
  if (auto* ratio = std::get_if<BaseRatio>(quantity)) {
    add_group(&ratio->of);
    add_group(&ratio->over);
  }
  return blocks;
}

}  // namespace

int block_at(const Assembly& assembly, const Vec3& point, const std::string& key) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : assembly.parts) {
    const double outside = distance_from_part(assembly, part, point);
    if (assembly.blocks[part.block].fixed || outside >= least) continue;
    least = outside;
    nearest = part.block;
  }
  if (nearest < 0) throw InputError(key + ": the assembly has no free block to carry a force");
  constexpr double kFarthest = 0.1;  // of the size of the block
  if (least > kFarthest * std::cbrt(assembly.blocks[nearest].volume))
    throw InputError(
        fmt::format("{}: ({:g}, {:g}, {:g}) m lies in the air, {:.3g} m beyond the faces of the "
                    "nearest block, {}; move the point, or name the `block` that carries the force",
                    key, point.x(), point.y(), point.z(), least, nearest));
  return nearest;
}

void resolve_block_names(const Assembly& assembly, Loads* loads, Ties* ties, Supports* supports) {
  const BlockNames names(assembly);
  // `key`: of the item, so that a message finds the place that gives it, perhaps an option.
  const auto resolve_in = [&](const char* list, const char* key, auto* items, const auto& blocks_of_item) {
    for (size_t i = 0; i < items->size(); ++i)
      for (BlockRef* block : blocks_of_item(&(*items)[i]))
        names.resolve(fmt::format("{}[{}].{}", list, i, key), block);
  };
  const auto of_region = [](auto* item) { return pointers_to(&item->region.blocks); };
  resolve_in("loads.forces", "block", &loads->forces, [](BlockForce* force) {
    return force->block == BlockForce::kAtPoint ? std::vector<BlockRef*>() : std::vector{&force->block};
  });
  for (size_t i = 0; i < loads->forces.size(); ++i)
    if (BlockForce& force = loads->forces[i]; force.is_at_point())
      force.block = block_at(assembly, *force.point, fmt::format("loads.forces[{}].point", i));
  resolve_in("ties.pairs", "block_a", &ties->pairs, [](PairTie* tie) { return std::vector{&tie->block_a}; });
  resolve_in("ties.pairs", "block_b", &ties->pairs, [](PairTie* tie) { return std::vector{&tie->block_b}; });
  resolve_in("supports.restraints", "block", &supports->restraints,
             [](Restraint* restraint) { return std::vector{&restraint->block}; });
  resolve_in("supports.moves", "blocks", &supports->moves, of_region);
  resolve_in("loads.heat", "blocks", &loads->heat, of_region);
}

void resolve_block_names(const Assembly& assembly, std::vector<ForceQuantity>* quantities) {
  const BlockNames names(assembly);
  for (size_t i = 0; i < quantities->size(); ++i)
    for (BlockRef* block : blocks_of(&(*quantities)[i]))
      names.resolve(fmt::format("analysis.range.quantities[{}]", i), block);
}

void check_block_exists(const Assembly& assembly, int block, const std::string& key) {
  const int num_blocks = static_cast<int>(assembly.blocks.size());
  if (block < 0 || block >= num_blocks)
    throw InputError(fmt::format("{}: block {} does not exist: the assembly has blocks 0 to {}", key, block,
                                 num_blocks - 1));
}

void check_member_exists(const Assembly& assembly, const std::string& member, const std::string& key) {
  if (member.empty() || std::ranges::find(assembly.members, member) != assembly.members.end()) return;
  const std::string near = nearest_name(member, assembly.members);
  std::string names;
  for (const std::string& name : assembly.members) names += (names.empty() ? "" : ", ") + name;
  throw InputError(fmt::format("{}: no member is named '{}'{}", key, member,
                               !near.empty()              ? fmt::format("; did you mean '{}'?", near)
                               : assembly.members.empty() ? "; a model of one shell has no named members"
                                                          : "; the members are " + names));
}

void resolve_block_name(const Assembly& assembly, const std::string& key, BlockRef* block) {
  BlockNames(assembly).resolve(key, block);
}

}  // namespace cupola
