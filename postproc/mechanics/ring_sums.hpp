#pragma once

#include <vector>

#include "assembly/model/applied_loads.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// The first ring of a block; -1 for a support, below all rings. Imported blocks without rings are in ring 0.
int ring_above_support(const Block& block);

/// The same; a block that is left out is a support, too.
int ring_above_support(const Assembly& assembly, int block, const std::vector<bool>& left_out);

/// The cut below ring k: forces of all other blocks on the blocks whose first ring is k or higher, against
/// the weight of these blocks and the loads on them.
struct RingSum {
  int ring = 0;
  /// m, mean height of the ring's bed joints, weighted by area; without any of its bed as built, NaN if the
  /// shell has none.
  double height = 0.0;
  int blocks = 0;                    ///< number of blocks whose first ring is k; 0: no cut, the sums are 0
  Vec3 joint_force = Vec3::Zero();   ///< N, of joints and ties on the blocks above the cut
  Vec3 load_above = Vec3::Zero();    ///< N, weight of these blocks and loads on them
  double relative_difference = 0.0;  ///< |joint_force + load_above| / |load_above|
  double mean_resultant = 0.0;       ///< N, mean force of the ring's blocks from the ring below
  double cv_resultant = 0.0;         ///< coefficient of variation of these forces
  double cv_pressure = 0.0;          ///< the same of normal force over joint area, for blocks of unequal size
  /// N, sum of the horizontal outward forces across the cut on blocks below it in the stack, and of the ring on
  /// supports; NaN without a vault, as Assembly::outward.
  double radial_thrust = 0.0;
  double largest_couple_length = 0.0;  ///< m, of a block's wrench from below
  double largest_friction_use = 0.0;   ///< of the ring's bed joints
  double largest_kern = 0.0;           ///< kern utilisation of the ring's bed joints
};

/// One cut per ring, from the base upwards; empty for blocks without rings. `left_out`: per block, true if it
/// does not take part, as before it is laid; empty: all take part. Each stack of sheets has cuts of its own.
std::vector<RingSum> ring_sums(const Assembly& assembly, const Shell& shell, const JointWrenches& joints,
                               const std::vector<Wrench>& from_below, const Vec3& gravity,
                               const std::vector<PointForce>& loads, const TieTable& ties = {},
                               const std::vector<bool>& left_out = {});

/// Standard deviation over |mean|; 0 for fewer than two values or a mean of zero.
double coefficient_of_variation(const std::vector<double>& values);

}  // namespace cupola
