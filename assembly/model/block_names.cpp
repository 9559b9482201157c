#include "assembly/model/block_names.hpp"

#include <map>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {

std::string block_label(const Assembly& assembly, int block) {
  const std::string& name = assembly.blocks.at(static_cast<size_t>(block)).name;
  return name.empty() ? std::to_string(block) : name;
}

void resolve_block_names(const Assembly& assembly, Loads* loads, Ties* ties, Supports* supports) {
  std::map<std::string, int> number_of;
  std::vector<std::string> names;
  for (size_t b = 0; b < assembly.blocks.size(); ++b) {
    if (assembly.blocks[b].name.empty()) continue;
    number_of[assembly.blocks[b].name] = static_cast<int>(b);
    names.push_back(assembly.blocks[b].name);
  }
  const auto resolve = [&](const char* key, BlockRef* block) {
    if (block->name.empty()) return;
    const auto found = number_of.find(block->name);
    if (found == number_of.end()) {
      const std::string near = nearest_name(block->name, names);
      throw InputError(fmt::format("{}: no block is named '{}'{}", key, block->name,
                                   !near.empty() ? fmt::format("; did you mean '{}'?", near)
                                   : names.empty()
                                       ? "; generated blocks have numbers only"
                                       : fmt::format("; the first block is '{}'", names.front())));
    }
    *block = found->second;
  };
  for (BlockForce& force : loads->forces) resolve("loads.forces", &force.block);
  for (PairTie& pair : ties->pairs) {
    resolve("ties.pairs", &pair.block_a);
    resolve("ties.pairs", &pair.block_b);
  }
  for (SupportMove& move : supports->moves)
    for (BlockRef& block : move.blocks) resolve("supports.moves", &block);
}

}  // namespace cupola
