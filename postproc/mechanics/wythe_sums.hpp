#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/poses.hpp"

namespace cupola {

/// What passes through a wythe of the cut below ring k: the joints that lie in it, see wythes_of(). A joint
/// between two bonders lies in several wythes and has a sum of its own, since nothing tells how its force is
/// shared among them. Over all sums of a ring, the forces add up to those of its ring cut without ties.
struct WytheSum {
  int ring = 0;
  WytheRange wythes;
  int joints = 0;               ///< bed joints under blocks that begin in the ring
  double area = 0.0;            ///< m2, of these joints
  double vertical_force = 0.0;  ///< N, of all joints across the cut on the blocks above, positive upwards
  double share = 0.0;           ///< of the sum over the ring; 0 if that is negligible
  double outward_force = 0.0;  ///< N, sum of the horizontal outward forces on the blocks below; NaN: no vault
  /// Mean place of the normal forces of its bed joints through the thickness of the wythes: 0 on their inner,
  /// 1 on their outer side. NaN without such forces.
  double position = 0.0;
  double pressure = 0.0;              ///< Pa, normal force of its bed joints over their area; 0 without any
  double cv_pressure = 0.0;           ///< coefficient of variation of the pressure of its bed joints
  double largest_friction_use = 0.0;  ///< of its bed joints
  double largest_kern = 0.0;          ///< kern utilisation of its bed joints
};

/// Ring by ring from the base upwards, in each the wythes from the inside; empty for a shell without wythes.
std::vector<WytheSum> wythe_sums(const Assembly& assembly, const Shell& shell, const JointWrenches& joints,
                                 const ContactTable& contacts, const Poses& poses = {});

}  // namespace cupola
