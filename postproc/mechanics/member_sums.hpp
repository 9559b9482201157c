#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// What one member of a shell with wythes (a wythe or a group of bonders) carries through the cut below ring
/// k: forces of the blocks below the cut, and of supports, on its blocks whose first ring is k or higher.
struct MemberSum {
  int ring = 0;
  int member = 0;               ///< index into Assembly::members
  int blocks = 0;               ///< its blocks that begin in the ring
  double weight = 0.0;          ///< N, of these blocks under `gravity`
  double vertical_force = 0.0;  ///< N, on the blocks above, positive upwards
  double share = 0.0;           ///< of the sum over all members; 0 if that is negligible
  double outward_force = 0.0;  ///< N, sum of the horizontal outward forces on the blocks below; NaN: no vault
};

/// Ring by ring from the base upwards, one row per member with blocks in the ring or forces through the cut;
/// empty for a shell without wythes. `left_out`: per block, true if it does not take part (num_blocks);
/// empty: all do.
std::vector<MemberSum> member_sums(const Assembly& assembly, const JointWrenches& joints, const Vec3& gravity,
                                   const std::vector<bool>& left_out = {});

}  // namespace cupola
