#pragma once

#include <vector>

#include "solver/contact/blocks/block_rows.hpp"
#include "solver/contact/blocks/rigid_motions.hpp"

namespace cupola {

/// Neighbouring blocks gathered in groups, each of which moves as one on the coarser level.
struct Aggregates {
  std::vector<int> group;   ///< of each block (nb)
  std::vector<int> centre;  ///< block about which a group gathered (num_groups)
  int num_groups() const { return static_cast<int>(centre.size()); }
};

/// Blocks that A couples strongly and that can touch where their motions have them. Greedy, after Vanek,
/// Mandel and Brezina (1996): those all of whose strong neighbours are free take these as their group; what
/// is left joins the group that holds it most strongly, and makes groups of its own where there is none. Of
/// groups of bricks in a shell each has some seven members.
Aggregates gather(const BlockRows& A, const RigidMotions& motions);

}  // namespace cupola
