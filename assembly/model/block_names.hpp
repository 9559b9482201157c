#pragma once

#include <string>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/force_quantity.hpp"
#include "assembly/model/loads.hpp"

namespace cupola {

/// Name of a block for messages and tables: its name in the imported file, else its number.
std::string block_label(const Assembly& assembly, int block);

/// The labels of the first eight of several blocks: "12, 13, ...".
std::string block_labels(const Assembly& assembly, const std::vector<int>& blocks);

/// The free block that contains the point, or whose faces it is least beyond: at most a tenth of the size of
/// the block, as the point of a curved skin lies beyond the chord of a facet. Throws InputError beyond that.
int block_at(const Assembly& assembly, const Vec3& point, const std::string& key);

/// Replaces the names of blocks in a case by their numbers, and gives forces at points their blocks, as built.
/// Fixed blocks without a name are called `support 0`, `support 1`, ... in their order. Throws InputError for
/// a name or number that no block has, with the nearest name.
void resolve_block_names(const Assembly& assembly, Loads* loads, Ties* ties, Supports* supports);
void resolve_block_names(const Assembly& assembly, std::vector<ForceQuantity>* quantities);
/// `key` of the case is for the message.
void resolve_block_name(const Assembly& assembly, const std::string& key, BlockRef* block);

/// Throws InputError that begins with `key` for a block that does not exist.
void check_block_exists(const Assembly& assembly, int block, const std::string& key);
/// The same for the name of a member, wythe or group of bonders, with the nearest name; "" names none.
void check_member_exists(const Assembly& assembly, const std::string& member, const std::string& key);

/// What to do about an imported model without supports.
inline constexpr const char* kNoBlockIsFixed =
    "no block is fixed: set geometry.import.supports, flagged_supports, fixed_by or fixed_below";

}  // namespace cupola
