#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/heat.hpp"
#include "solver/dynamics/joint_laws.hpp"
#include "solver/dynamics/loads.hpp"
#include "solver/dynamics/supports.hpp"
#include "solver/dynamics/ties.hpp"

namespace cupola {

/// Inertia of a block and of what stands on it, about the centroid of the block, in its axes.
struct BodyMass {
  double mass = 0.0;                 ///< kg
  Vec3 first_moment = Vec3::Zero();  ///< kg m: 0 of the block alone
  Mat3 inertia = Mat3::Zero();       ///< kg m2
};

/// The time-independent description of a scene: masses, loads, joint laws, ties and imposed support motions.
/// Fixed blocks have no unknowns.
struct Model {
  const Assembly* assembly = nullptr;
  JointTable joints;
  TimeFunction friction_time;  ///< factor on every friction coefficient
  LoadSet loads;
  std::vector<Tie> ties;
  bool ties_yield = false;  ///< at least one of them does
  GroundMotion ground;
  std::vector<SupportMotion> support_motions;  ///< that of the ground among them
  HeatedBlocks heat;
  std::vector<int> free_index;   ///< block -> row block, or ContactProblem::kFixed (num_blocks)
  std::vector<int> free_blocks;  ///< row block -> block (nb)
  std::vector<BodyMass> bodies;  ///< (num_blocks); lantern and top load count in motions only
  double free_weight = 0.0;      ///< N, total weight of the free blocks under full gravity
  double block_weight = 0.0;     ///< N, mean weight of the free blocks
  bool plane = false;            ///< motion in x-z only: unknowns x, z, rot y (see plane_scene.hpp)

  /// Joints have tension, cohesion or compressive strength, or ties yield.
  bool has_strength() const { return joints.has_strength() || ties_yield; }
  int num_free() const { return static_cast<int>(free_blocks.size()); }
  int num_unknowns() const { return (plane ? 3 : 6) * num_free(); }
};

/// Builds the model of a case. The assembly must outlive it. Throws InputError for loads, ties or support
/// motions that do not fit the assembly.
Model make_model(const Case& scene, const Assembly& assembly);

/// Positions and velocities of all blocks.
struct State {
  double time = 0.0;           ///< s
  std::vector<Pose> poses;     ///< (num_blocks)
  VecX v;                      ///< m/s, rad/s: linear then angular, world axes (6 nb, free blocks)
  Vec3 ground = Vec3::Zero();  ///< m, displacement of the ground, which the poses contain
};

/// The state relative to the ground: without its displacement and without its mean velocity over the last step
/// h (s), which a block that rests on it has in this scheme.
State seen_from_ground(const Model& model, const State& state, double h);

/// All blocks at rest as generated. The first static step moves the supports to where they are at its end.
State state_at_rest(const Model& model);

/// Moves the supports of a state to their imposed positions at its time.
void move_supports(const Model& model, State* state);

/// Contacts at rest. A joint that a support opens or closes by time 0 is found however far it moves, up to the
/// size of a block.
const ContactSet& contacts_at_rest(const Model& model, ContactDetector* detector);

/// m, of the centroids from the assembly as generated (num_blocks).
std::vector<Vec3> displacements(const Assembly& assembly, const State& state);

/// Mass matrix of a block about its centroid, in world axes.
Mat6 mass_matrix(const BodyMass& body, const Eigen::Quaterniond& q_WB);

/// Applied forces and moments about the centroids (N, N m; 6 nb): gravity and loads at `time` (s), the
/// gyroscopic moment -omega x (I omega) and, with the first moment s of what stands on a block, the
/// centrifugal force -omega x (omega x s).
VecX applied_forces(const Model& model, const State& state, double time);

/// Acceleration that scales the speeds in residuals, m/s2: the largest load per mass of a free block at full
/// dead load, usually gravity. 1 if no load acts.
double reference_acceleration(const Model& model, const State& state);

/// Advances the time by `time_advance` (s), moves the supports to their imposed positions at the new time,
/// and moves the free blocks by the velocities v (6 nb):
///
///     p += h v,   q = exp(h omega) q
///
/// This is paper eq. 11 with the exponential map of the rotation.
void integrate_positions(const Model& model, double h, double time_advance, const VecX& v, State* state);

/// Friction at `time` (s) and compliance of one contact point.
JointLaw joint_law(const Model& model, const ContactSet& contacts, const Contact& contact, double time);

/// Gap of tie k, m: positive when slack, without plastic elongation. Heat has moved its ends.
double tie_gap(const Model& model, const State& state, size_t k);

/// Largest speed of a free block's centroid, m/s.
double largest_speed(const VecX& v);

}  // namespace cupola
