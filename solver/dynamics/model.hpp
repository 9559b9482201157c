#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/dynamics/joint_laws.hpp"
#include "solver/dynamics/loads.hpp"
#include "solver/dynamics/supports.hpp"
#include "solver/dynamics/ties.hpp"

namespace cupola {

/// What of a scene does not change while it moves: masses, loads, joint laws, ties, the motion that is
/// imposed on supports. Fixed blocks have no unknowns.
struct Model {
  const Assembly* assembly = nullptr;
  JointTable joints;
  TimeFunction friction_time;  ///< factor on every friction coefficient
  LoadSet loads;
  std::vector<Tie> ties;
  std::vector<SupportMotion> support_motions;
  std::vector<int> free_index;   ///< block -> its row block, or ContactProblem::kFixed (num_blocks)
  std::vector<int> free_blocks;  ///< row block -> block (nb)
  double free_weight = 0.0;      ///< N, of the blocks that are not fixed, under full gravity
  double block_weight = 0.0;     ///< N, mean over the free blocks
  bool plane = false;            ///< motion in x-z alone: unknowns x, z, rot y (see plane_scene.hpp)

  int num_free() const { return static_cast<int>(free_blocks.size()); }
  int num_unknowns() const { return (plane ? 3 : 6) * num_free(); }
};

/// Builds the model of a case. The assembly must outlive it. Throws InputError when the case asks for loads,
/// ties or support motions that the assembly cannot have.
Model make_model(const Case& scene, const Assembly& assembly);

/// Positions and velocities of all blocks.
struct State {
  double time = 0.0;        ///< s
  std::vector<Pose> poses;  ///< (num_blocks)
  VecX v;                   ///< m/s, rad/s: linear then angular, world axes (6 nb, free blocks)
};
/// As built, supports where their motion puts them at time 0.
State state_at_rest(const Model& model);

/// Mass matrix of one free block with its inertia turned into world axes.
Mat6 mass_matrix(const Block& block, const Eigen::Quaterniond& q_WB);

/// Applied forces and moments about the centroids: gravity, loads at `time`, gyroscopic -omega x (I omega),
/// N, N m (6 nb).
VecX applied_forces(const Model& model, const State& state, double time);

/// Acceleration that sets the scale of speeds in residuals: the largest load per mass of a free block at full
/// dead load, gravity as a rule, m/s2. 1 where nothing acts.
double reference_acceleration(const Model& model, const State& state);

/// Moves positions of the free blocks by the velocities: p += h v, q = exp(h omega) q (paper eq. 11 with the
/// velocity at the end of the step, Lie exponential for the rotation), and supports to where they are at the
/// new time, `time_advance` (s) later.
void integrate_positions(const Model& model, double h, double time_advance, State* state);

/// Friction (at `time`) and compliance of one contact point.
JointLaw joint_law(const Model& model, const ContactSet& contacts, const Contact& contact, double time);

/// Largest speed of a free block's centroid, m/s.
double largest_speed(const VecX& v);

}  // namespace cupola
