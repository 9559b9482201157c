#pragma once

#include "solver/dynamics/model.hpp"

namespace cupola {

/// What holds the blocks together in one step.
struct JointForces {
  std::vector<Vec3> contacts;  ///< N, world, on block b of each contact
  std::vector<double> ties;    ///< N, along each tie's normal, >= 0: tension of a tie, thrust of a strut
};

/// Impulses of a step as forces.
JointForces joint_forces(const ContactSet& contacts, const VecX& gamma, double h);

/// Balance of forces recomputed from contact points and world forces, apart from the solver's matrices.
struct Equilibrium {
  /// Largest unbalanced force of a free block over the mean block weight, and moment over weight times block
  /// size (cube root of the volume). Inertia counts as imbalance: in statics nothing moves.
  double residual = 0.0;
  int worst_block = -1;
  Vec3 applied_load = Vec3::Zero();      ///< N, gravity and loads on the free blocks
  Vec3 support_reaction = Vec3::Zero();  ///< N, of fixed blocks on free ones
  double inertia_share = 0.0;            ///< part of the applied load, along it, that no support carries
};

/// Balance of two parts of a scene that have no joint with each other, together.
Equilibrium joined(const Equilibrium& a, const Equilibrium& b);

/// `time`: s, at which the loads are taken.
Equilibrium compute_equilibrium(const Model& model, const State& state, const ContactSet& contacts,
                                const JointForces& forces, double time);

}  // namespace cupola
