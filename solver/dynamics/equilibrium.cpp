#include "solver/dynamics/equilibrium.hpp"

#include <cmath>

#include "solver/dynamics/time_step.hpp"

namespace cupola {

Equilibrium compute_equilibrium(const Model& model, const State& state, const ContactSet& contacts,
                                const std::vector<Vec3>& contact_forces) {
  const std::vector<Block>& blocks = model.assembly->blocks;
  std::vector<Vec3> force(blocks.size(), Vec3::Zero());
  std::vector<Vec3> moment(blocks.size(), Vec3::Zero());
  Equilibrium balance;
  for (size_t i = 0; i < blocks.size(); ++i) force[i] = blocks[i].mass * model.gravity;
  for (const PointLoad& load : model.loads) {
    force[load.block] += load.force;
    moment[load.block] += (state.poses[load.block].q_WB * load.p_BP_B).cross(load.force);
  }
  for (int block : model.free_blocks) balance.applied_load += force[block];

  for (size_t i = 0; i < contact_forces.size(); ++i) {
    const Contact& contact = contacts.contacts[i];
    const Vec3 point = 0.5 * (contact.point_a + contact.point_b);
    const Vec3& f = contact_forces[i];
    force[contact.block_b] += f;
    moment[contact.block_b] += (point - state.poses[contact.block_b].p_WB).cross(f);
    force[contact.block_a] -= f;
    moment[contact.block_a] -= (point - state.poses[contact.block_a].p_WB).cross(f);
    if (blocks[contact.block_a].fixed && !blocks[contact.block_b].fixed) balance.support_reaction += f;
    if (blocks[contact.block_b].fixed && !blocks[contact.block_a].fixed) balance.support_reaction -= f;
  }

  // Without weight the loads set the scale; without either any imbalance is absolute, in newtons.
  double scale = model.block_weight;
  if (scale == 0.0) scale = balance.applied_load.norm();
  if (scale == 0.0) scale = 1.0;
  for (int block : model.free_blocks) {
    const double size = std::cbrt(blocks[block].volume);
    const double unbalanced = std::max(force[block].norm(), moment[block].norm() / size) / scale;
    // Written so that NaN counts as the worst.
    if (!(unbalanced <= balance.residual)) {
      balance.residual = unbalanced;
      balance.worst_block = block;
    }
  }
  const double applied = balance.applied_load.squaredNorm();
  if (applied > 0.0)
    balance.inertia_share = 1.0 + balance.support_reaction.dot(balance.applied_load) / applied;
  return balance;
}

std::vector<Vec3> world_forces(const ContactSet& contacts, const VecX& gamma, double h) {
  std::vector<Vec3> forces(contacts.contacts.size());
  for (size_t i = 0; i < forces.size(); ++i)
    forces[i] =
        contact_frame(contacts.contacts[i].normal) * gamma.segment<3>(3 * static_cast<Eigen::Index>(i)) / h;
  return forces;
}

}  // namespace cupola
