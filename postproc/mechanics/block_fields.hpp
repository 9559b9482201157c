#pragma once

#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "assembly/model/applied_loads.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/poses.hpp"
#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// Derived quantities of one block in one frame.
struct BlockFields {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double resultant = 0.0;         ///< N, norm of the force from the ring below
  double couple_length = 0.0;     ///< m, of that wrench; NaN if it is negligible
  double meridional_force = 0.0;  ///< N per metre of ring, compression positive
  double hoop_force = 0.0;        ///< N per metre of meridian, compression positive
  double friction_use = kNone;    ///< largest friction utilisation of its loaded joints; NaN without any
  double kern = kNone;            ///< largest kern utilisation of its loaded bed joints; NaN without any
  double opening = 0.0;           ///< m, widest opening of its joints
  double slip = 0.0;              ///< m, largest accumulated slip at its joints
};

/// The fields of every block, by block.
///
/// Meridional and hoop force come from the mean stress of the block, summed over its contacts and loads,
///
///     sigma = 1/V  sum (x - c) f^T        (Love, Weber; holds for a block in equilibrium)
///
/// turned back to the block as built, whose axes are given, as -m.sigma.m and -t.sigma.t times the thickness
/// of the shell. They thus average over the block the friction on its beds and the pressure on its heads. At a
/// pole, where all meridians meet, both are the mean over all directions. They are zero for fixed blocks, for
/// blocks without shell axes, and up to the floor of forces over the size of a block.
std::vector<BlockFields> block_fields(const Assembly& assembly, const Frame& frame,
                                      const JointWrenches& joints, const std::vector<Wrench>& from_below,
                                      const std::vector<PointForce>& loads,
                                      const std::vector<ShellAxes>& axes, const Poses& poses);

/// Group number of every block; the blocks of one group move as one body. `poses`: of every block, from where
/// it was built.
///
/// A joint connects its blocks unless the motion of one moves a corner of the other by more than `threshold`
/// (m) away from it; the groups are the connected components. Joints themselves do not tell: an open hinge
/// touches only where it does not move. All fixed blocks form group 0, the others are numbered in the order
/// of their first block.
std::vector<int> mechanism_groups(const Assembly& assembly, const std::vector<Eigen::Isometry3d>& poses,
                                  const JointWrenches& joints, double threshold);

}  // namespace cupola
