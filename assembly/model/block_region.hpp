#pragma once

#include <string>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/loads.hpp"

namespace cupola {

/// A block of a region, with the factor of the region's profile.
struct RegionBlock {
  int block = 0;
  double factor = 1.0;
};

/// The fixed, or the free, blocks of a region in the order of their numbers. `key` of the case is for
/// messages. Throws InputError for blocks and members that do not exist, for listed blocks of the other kind,
/// for a region without blocks, and for a sector or profile of a block on the axis.
std::vector<RegionBlock> blocks_of_region(const BlockRegion& region, const Assembly& assembly, bool fixed,
                                          const std::string& key);

/// Horizontal unit vector outwards at the centroid of a fixed block, see Assembly::outward: that of the sheet
/// whose nearest free block it supports. Throws InputError for a block on the axis, and without a vault.
Vec3 outward_of_support(const Assembly& assembly, int block, const std::string& key);

}  // namespace cupola
