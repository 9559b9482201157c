#pragma once

#include <vector>

#include "solver/contact/blocks/block_rows.hpp"
#include "solver/contact/blocks/rigid_motions.hpp"

namespace cupola {

/// A partition of the blocks into aggregates of neighbours. Each aggregate is one block of the coarser level.
struct Aggregates {
  std::vector<int> aggregate;  ///< of each block (nb)
  std::vector<int> centre;     ///< block from which each aggregate was formed (size())
  int size() const { return static_cast<int>(centre.size()); }
};

/// Aggregates of blocks that A couples strongly and that can touch, judged by their motions. Greedy, after
/// Vanek, Mandel and Brezina (1996): a block whose strong neighbours are all free forms an aggregate with
/// them; remaining blocks join the neighbouring aggregate with the strongest coupling, or form new ones.
/// Aggregates of bricks in a shell have about seven members.
Aggregates aggregate_blocks(const BlockRows& A, const RigidMotions& motions);

}  // namespace cupola
