#pragma once

#include <vector>

#include "assembly/model/applied_loads.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// The cut below ring k: what the blocks with first ring >= k receive from the rest, against what they weigh.
struct RingSum {
  int ring = 0;
  double height = 0.0;                 ///< m, mean height of the bed joints of the ring, weighted by area
  int blocks = 0;                      ///< blocks whose first ring it is
  Vec3 joint_force = Vec3::Zero();     ///< N, on the blocks above the cut
  Vec3 load_above = Vec3::Zero();      ///< N, their weight and the loads applied to them
  double relative_difference = 0.0;    ///< |joint_force + load_above| / |load_above|
  double mean_resultant = 0.0;         ///< N, of the blocks' wrenches from below
  double cv_resultant = 0.0;           ///< their coefficient of variation
  double cv_pressure = 0.0;            ///< of normal force over joint area: evens out unequal blocks
  double radial_thrust = 0.0;          ///< N, sum of the outward horizontal components passed downwards
  double largest_couple_length = 0.0;  ///< m
  double largest_friction_use = 0.0;   ///< of the ring's bed joints
  double largest_kern = 0.0;           ///< kern_use of the ring's bed joints, loaded ones
};

/// One row per ring; none for blocks without rings.
std::vector<RingSum> ring_sums(const Assembly& assembly, const JointWrenches& joints,
                               const std::vector<Wrench>& from_below, const Vec3& gravity,
                               const std::vector<PointForce>& loads);

/// Standard deviation over mean; 0 for fewer than two values or no mean.
double coefficient_of_variation(const std::vector<double>& values);

}  // namespace cupola
