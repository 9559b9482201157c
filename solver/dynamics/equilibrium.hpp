#pragma once

#include "solver/dynamics/model.hpp"

namespace cupola {

/// Forces between the blocks in one step.
struct JointForces {
  std::vector<Vec3> contacts;  ///< N, world, acting on block b (nc)
  std::vector<double> ties;    ///< N, >= 0: tension of a tie, thrust of a strut (number of ties)
};

/// Forces of a step from its impulses `gamma` (N s): gamma / impulse_time (s, one per contact) in world axes.
JointForces joint_forces(const ContactSet& contacts, const VecX& gamma, const VecX& impulse_time);

/// Balance of forces and moments, computed from contact points and world forces independently of the matrices
/// of the contact problem.
struct Equilibrium {
  /// Largest over the free blocks of |F| / W and |M| / (W L): F, M unbalanced force and moment about the
  /// centroid, W mean block weight, L cube root of the volume of the block. Inertia counts as imbalance.
  double residual = 0.0;
  Vec3 applied_load = Vec3::Zero();      ///< N, gravity and loads on the free blocks
  Vec3 support_reaction = Vec3::Zero();  ///< N, of fixed blocks on free blocks
  double inertia_share = 0.0;            ///< fraction of the applied load that the supports do not carry
};

/// Balance of a scene from the balances of two parts that no force connects.
Equilibrium combine(const Equilibrium& a, const Equilibrium& b);

/// Loads are evaluated at `time` (s).
Equilibrium compute_equilibrium(const Model& model, const State& state, const ContactSet& contacts,
                                const JointForces& forces, double time);

}  // namespace cupola
