#include "solver/dynamics/energy.hpp"

#include <algorithm>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

double potential_energy(const Model& model, const std::vector<Pose>& poses, double time) {
  const std::vector<Block>& blocks = model.assembly->blocks;
  const Vec3 gravity = model.loads.gravity_at(time);
  double energy = 0.0;
  for (const int block : model.free_blocks)
    energy -= blocks[block].mass * gravity.dot(poses[block].p_WB - blocks[block].centroid);
  for (const PointLoad& load : model.loads.points) {
    const Pose& pose = poses[load.block];
    const Vec3 moved = pose.p_WB + pose.q_WB * load.p_BP_B - (blocks[load.block].centroid + load.p_BP_B);
    energy -= model.loads.factor(load, time) * load.force.dot(moved);
  }
  return energy;
}

double tie_energy(const Model& model, const State& state, const ContactMemories& memories) {
  double energy = 0.0;
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const double yielded = memories.ties.empty() ? 0.0 : memories.ties[k].yielded;
    const double stretch = std::min(0.0, tie_gap(model, state, k) + yielded);
    energy += 0.5 * stretch * stretch / model.ties[k].compliance;
  }
  return energy;
}

Energy compute_energy(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories) {
  Energy energy;
  energy.potential = potential_energy(model, state.poses, state.time);
  energy.elastic = tie_energy(model, state, memories);
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Eigen::Matrix<double, 6, 1> v = state.v.segment<6>(6 * i);
    energy.kinetic += 0.5 * v.dot(mass_matrix(model.bodies[block], state.poses[block].q_WB) * v);
  }
  CUPOLA_ASSERT(memories.ids.size() == contacts.points.size());
  constexpr double kOperationsPerContact = 50.0;
  const auto nc = static_cast<int>(contacts.points.size());
  std::vector<double> stored(contacts.points.size(), 0.0);  // J, of each contact
  share_range(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const JointLaw law = joint_law(model, contacts, contacts.points[i], state.time);
      const ContactMemory& memory = memories.of(i);
      if (law.compliance_normal > 0.0)
        stored[i] += 0.5 * memory.elastic_gap * memory.elastic_gap / law.compliance_normal;
      if (law.compliance_tangential > 0.0)
        stored[i] += 0.5 * memory.elastic_slip_A.squaredNorm() / law.compliance_tangential;
    }
  });
  for (const double value : stored) energy.elastic += value;
  return energy;
}

}  // namespace cupola
