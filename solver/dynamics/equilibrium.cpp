#include "solver/dynamics/equilibrium.hpp"

#include <cmath>

#include "assembly/base/error.hpp"
#include "solver/dynamics/time_step.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// Forces and moments about the centroids (num_blocks).
struct BlockForces {
  std::vector<Vec3> force;   // N
  std::vector<Vec3> moment;  // N m
};

BlockForces applied_loads(const Model& model, const State& state, double time) {
  const std::vector<Block>& blocks = model.assembly->blocks;
  BlockForces sum{std::vector<Vec3>(blocks.size(), Vec3::Zero()),
                  std::vector<Vec3>(blocks.size(), Vec3::Zero())};
  const Vec3 gravity = model.loads.gravity_at(time);
  for (size_t i = 0; i < blocks.size(); ++i) sum.force[i] = blocks[i].mass * gravity;
  for (const PointLoad& load : model.loads.points) {
    const Vec3 force = model.loads.factor(load, time) * load.force;
    sum.force[load.block] += force;
    sum.moment[load.block] += (state.poses[load.block].q_WB * load.p_BP_B).cross(force);
  }
  return sum;
}

double inertia_share(const Equilibrium& balance) {
  const double applied = balance.applied_load.squaredNorm();
  return applied > 0.0 ? 1.0 + balance.support_reaction.dot(balance.applied_load) / applied : 0.0;
}

}  // namespace

Equilibrium combine(const Equilibrium& a, const Equilibrium& b) {
  Equilibrium both = a.residual <= b.residual ? b : a;  // NaN counts as the largest
  if (std::isnan(b.residual)) both = b;
  both.applied_load = a.applied_load + b.applied_load;
  both.support_reaction = a.support_reaction + b.support_reaction;
  both.inertia_share = inertia_share(both);
  return both;
}

JointForces joint_forces(const ContactSet& contacts, const VecX& gamma, const VecX& impulse_time) {
  JointForces forces;
  constexpr double kOperationsPerContact = 60.0;
  const auto nc = static_cast<int>(contacts.points.size());
  CUPOLA_ASSERT(gamma.size() >= 3 * nc && gamma.size() == 3 * impulse_time.size());
  forces.contacts.resize(contacts.points.size());
  share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i)
      forces.contacts[i] =
          contact_frame(contacts.points[i].normal) * gamma.segment<3>(3 * i) / impulse_time[i];
  });
  for (Eigen::Index row = 3 * nc; row < gamma.size(); row += 3)
    forces.ties.push_back(gamma[row] / impulse_time[row / 3]);
  return forces;
}

Equilibrium compute_equilibrium(const Model& model, const State& state, const ContactSet& contacts,
                                const JointForces& forces, double time) {
  const std::vector<Block>& blocks = model.assembly->blocks;
  CUPOLA_ASSERT(state.poses.size() == blocks.size());
  CUPOLA_ASSERT(forces.contacts.size() == contacts.points.size());
  CUPOLA_ASSERT(forces.ties.empty() || forces.ties.size() == model.ties.size());
  Equilibrium balance;
  BlockForces sum = applied_loads(model, state, time);
  for (int block : model.free_blocks) balance.applied_load += sum.force[block];

  const auto is_fixed = [&](int block) { return model.free_index[block] == ContactProblem::kFixed; };
  const auto add = [&](int a, int b, const Vec3& point_a, const Vec3& point_b, const Vec3& on_b) {
    sum.force[b] += on_b;
    sum.moment[b] += (point_b - state.poses[b].p_WB).cross(on_b);
    sum.force[a] -= on_b;
    sum.moment[a] -= (point_a - state.poses[a].p_WB).cross(on_b);
    if (is_fixed(a) && !is_fixed(b)) balance.support_reaction += on_b;
    if (is_fixed(b) && !is_fixed(a)) balance.support_reaction -= on_b;
  };
  for (size_t i = 0; i < forces.contacts.size(); ++i) {
    const Contact& contact = contacts.points[i];
    const Vec3 point = 0.5 * (contact.point_a + contact.point_b);
    add(contact.block_a, contact.block_b, point, point, forces.contacts[i]);
  }
  for (size_t k = 0; k < forces.ties.size(); ++k) {
    const TieGeometry tie = tie_geometry(model.ties[k], state.poses, state.ground);
    add(model.ties[k].block_a, model.ties[k].block_b, tie.point_a, tie.point_b, forces.ties[k] * tie.normal);
  }

  // Without weight the loads set the scale. Without either, the residual is in newtons.
  double scale = model.block_weight;
  if (scale == 0.0) scale = balance.applied_load.norm();
  if (scale == 0.0) scale = 1.0;
  for (int block : model.free_blocks) {
    const double size = std::cbrt(blocks[block].volume);
    const double unbalanced = std::max(sum.force[block].norm(), sum.moment[block].norm() / size) / scale;
    // Written so that NaN counts as the largest.
    if (!(unbalanced <= balance.residual)) balance.residual = unbalanced;
  }
  balance.inertia_share = inertia_share(balance);
  return balance;
}

}  // namespace cupola
