#pragma once

#include <vector>

#include "assembly/model/applied_loads.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// What one frame says about one block.
struct BlockFields {
  double resultant = 0.0;         ///< N, norm of the wrench from the ring below
  double couple_length = 0.0;     ///< m, of that wrench
  double meridional_force = 0.0;  ///< N per metre of ring, compression positive
  double hoop_force = 0.0;        ///< N per metre of meridian, compression positive
  double friction_use = 0.0;      ///< largest of its loaded joints
  double kern = 0.0;              ///< largest kern_use of its loaded bed joints
  double opening = 0.0;           ///< m, largest gap at its joints
  double slip = 0.0;              ///< m, largest accumulated slip at its joints
};

/// Meridional and hoop force come from the block's mean stress
/// sigma = 1/V sum (x - c) (x) f over its contacts and loads (Love, Weber), which holds for a block in
/// equilibrium: -m.sigma.m and -t.sigma.t times the shell's thickness. They average over the block what
/// its beds carry by friction and its heads by pressure. Zero for blocks outside the shell.
std::vector<BlockFields> block_fields(const Assembly& assembly, const Frame& frame,
                                      const JointWrenches& joints, const std::vector<Wrench>& from_below,
                                      const std::vector<PointForce>& loads,
                                      const std::vector<ShellAxes>& axes);

/// Groups of blocks that move as one body, numbered by their first block: the connected pieces when every
/// joint is cut whose two sides part or slide by more than `threshold` (m). Fixed blocks make group 0.
std::vector<int> mechanism_groups(const Assembly& assembly, const Frame& frame, const JointWrenches& joints,
                                  double threshold);

}  // namespace cupola
