#pragma once

#include "solver/dynamics/model.hpp"

namespace cupola {

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

/// `contact_forces`: N, world, on block b of each contact.
Equilibrium compute_equilibrium(const Model& model, const State& state, const ContactSet& contacts,
                                const std::vector<Vec3>& contact_forces);

/// Impulses of a step as world forces on block b, N.
std::vector<Vec3> world_forces(const ContactSet& contacts, const VecX& gamma, double h);

}  // namespace cupola
