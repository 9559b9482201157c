#pragma once

#include <string>
#include <vector>

#include "solver/analysis/record.hpp"
#include "solver/analysis/static_solve.hpp"

namespace cupola {

enum class JointMotion { closed, sliding, opening, hinging };
std::string to_string(JointMotion motion);

/// How two blocks part in a mechanism, over the contact points of their joint, relative to the fastest block.
struct MovingJoint {
  int block_a = 0, block_b = 0;
  JointKind kind = JointKind::other;
  int ring = 0;
  JointMotion motion = JointMotion::closed;
  double opening = 0.0;  ///< largest normal speed, -
  double sliding = 0.0;  ///< largest tangential speed of a point that stays closed, -
};

/// The velocity field that a structure without equilibrium takes, scaled so that the fastest block has
/// speed 1.
struct Mechanism {
  VecX v;                  ///< m/s, rad/s (6 nb)
  std::vector<int> group;  ///< of each block: blocks of a group move as one; 0 stays at rest (num_blocks)
  int num_groups = 0;      ///< moving ones
  std::vector<MovingJoint> joints;
  /// Kinematic certificate of the associated law: a velocity field that no contact hinders (D^T v in Y*) and
  /// on which the loads do positive work admits no equilibrium.
  double load_power = 0.0;  ///< f . v over the sum of |f_block| |v_block|, > 0
  double violation = 0.0;   ///< largest (mu |u_t| - u_n)+ of a contact, relative to the fastest block
};

/// The mechanism that a moving static solution shows.
Mechanism find_mechanism(const Model& model, const State& start, const ContactSet& contacts,
                         const StaticSolution& solution);

/// Tables of its blocks and joints.
std::string mechanism_blocks_csv(const Model& model, const Mechanism& mechanism);
std::string mechanism_joints_csv(const Mechanism& mechanism);

/// One line: how many groups move, how many joints slide, open and hinge, and where.
std::string describe(const Mechanism& mechanism);

}  // namespace cupola
