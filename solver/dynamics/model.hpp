#pragma once

#include <vector>

#include "assembly/assembly.hpp"
#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/contact/contact_problem.hpp"

namespace cupola {

/// A force of constant direction on a point that moves with its block.
struct PointLoad {
  int block = 0;
  Vec3 p_BP_B = Vec3::Zero();  ///< m, from the centroid, in the block's axes
  Vec3 force = Vec3::Zero();   ///< N, world
};

/// What of a scene does not change while it moves: masses, loads, joint laws. Fixed blocks have no unknowns.
struct Model {
  const Assembly* assembly = nullptr;
  Joints joints;
  Vec3 gravity = Vec3::Zero();   ///< m/s2
  std::vector<PointLoad> loads;  ///< everything applied but gravity
  std::vector<int> free_index;   ///< block -> its row block, or ContactProblem::kFixed (num_blocks)
  std::vector<int> free_blocks;  ///< row block -> block (nb)
  double free_weight = 0.0;      ///< N, of the blocks that are not fixed
  double block_weight = 0.0;     ///< N, mean over the free blocks

  int num_free() const { return static_cast<int>(free_blocks.size()); }
};

/// Builds the model of a case. The assembly must outlive it. Throws InputError when the case asks for a load
/// that the assembly cannot carry (no top faces).
Model make_model(const Case& scene, const Assembly& assembly);

/// Positions and velocities of all blocks.
struct State {
  double time = 0.0;        ///< s
  std::vector<Pose> poses;  ///< (num_blocks)
  VecX v;                   ///< m/s, rad/s: linear then angular, world axes (6 nb, free blocks)
};
State state_at_rest(const Model& model);

/// Mass matrix of one free block with its inertia turned into world axes.
Mat6 mass_matrix(const Block& block, const Eigen::Quaterniond& q_WB);

/// Applied forces and moments about the centroids: gravity, loads, gyroscopic -omega x (I omega), N, N m (6
/// nb).
VecX applied_forces(const Model& model, const State& state);

/// Acceleration that sets the scale of speeds in residuals: the largest load per mass of a free block,
/// gravity as a rule, m/s2.
double reference_acceleration(const Model& model, const State& state);

/// Moves positions by the velocities: p += h v, q = exp(h omega) q (paper eq. 11 with the velocity at the
/// end of the step, Lie exponential for the rotation).
void integrate_positions(const Model& model, double h, State* state);

/// Friction and compliance of one contact point of a patch.
struct JointLaw {
  double mu = 0.0;
  double compliance_normal = 0.0;      ///< m/N
  double compliance_tangential = 0.0;  ///< m/N
};
JointLaw joint_law(const Model& model, const Contact& contact);

}  // namespace cupola
