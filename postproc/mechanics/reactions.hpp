#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// What the structure does to one support: a fixed block with at least one joint or tie.
struct Reaction {
  int block = 0;
  int ring = 0;               ///< lowest course on it
  Vec3 force = Vec3::Zero();  ///< N, of its joints and ties on the support
  double outward = 0.0;       ///< N, sum of its joints along ThrustJoints::outward of the centroid of each
  double length =
      0.0;  ///< m, of its joints along the course: area over the thickness of the shell; NaN without one
};

/// m: the area of a joint on a support over the thickness of all wythes along the nearest facet on the beds
/// of the block that it carries; NaN without one.
double support_length(const JointWrench& joint, const Assembly& assembly, int carried, const Shell& shell);

/// In the order of the blocks. `num_ties`: of the ties those before the restraints, which push on the ground.
std::vector<Reaction> support_reactions(const Assembly& assembly, const JointWrenches& joints,
                                        const Shell& shell, const TieTable& ties = {}, int num_ties = 0);

/// Per block, the part of the structure to which it belongs: free blocks that joints and ties connect without
/// passing a support. The largest part is 0; -1 for supports.
std::vector<int> connected_parts(const Assembly& assembly, const JointWrenches& joints, const TieTable& ties);

}  // namespace cupola
