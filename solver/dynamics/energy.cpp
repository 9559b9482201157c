#include "solver/dynamics/energy.hpp"

namespace cupola {

Energy compute_energy(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories) {
  Energy energy;
  const std::vector<Block>& blocks = model.assembly->blocks;
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Pose& pose = state.poses[block];
    const Eigen::Matrix<double, 6, 1> v = state.v.segment<6>(6 * i);
    energy.kinetic += 0.5 * v.dot(mass_matrix(blocks[block], pose.q_WB) * v);
    energy.potential -= blocks[block].mass * model.gravity.dot(pose.p_WB - blocks[block].centroid);
  }
  for (const PointLoad& load : model.loads) {
    const Pose& pose = state.poses[load.block];
    const Vec3 moved = pose.p_WB + pose.q_WB * load.p_BP_B - (blocks[load.block].centroid + load.p_BP_B);
    energy.potential -= load.force.dot(moved);
  }
  for (size_t i = 0; i < memories.values.size(); ++i) {
    const JointLaw law = joint_law(model, contacts.contacts[i]);
    const ContactMemory& memory = memories.values[i];
    if (law.compliance_normal > 0.0)
      energy.elastic += 0.5 * memory.elastic_gap * memory.elastic_gap / law.compliance_normal;
    if (law.compliance_tangential > 0.0)
      energy.elastic += 0.5 * memory.elastic_slip_A.squaredNorm() / law.compliance_tangential;
  }
  return energy;
}

double friction_dissipation(const ContactProblem& problem, const ContactSolution& solution) {
  const VecX u = relative_velocity(problem, solution.v);
  double work = 0.0;
  for (Eigen::Index i = 0; i < problem.num_contacts(); ++i) {
    const Eigen::Vector2d gamma = solution.gamma.segment<2>(3 * i + 1);
    const Eigen::Vector2d elastic =
        -(problem.b.segment<2>(3 * i + 1) + problem.E.segment<2>(3 * i + 1).cwiseProduct(gamma));
    work -= gamma.dot(u.segment<2>(3 * i + 1) - elastic);
  }
  return work;
}

}  // namespace cupola
