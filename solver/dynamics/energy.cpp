#include "solver/dynamics/energy.hpp"

#include <algorithm>

#include "assembly/base/error.hpp"

namespace cupola {

Energy compute_energy(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories) {
  Energy energy;
  const std::vector<Block>& blocks = model.assembly->blocks;
  const Vec3 gravity = model.loads.gravity_at(state.time);
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Pose& pose = state.poses[block];
    const Eigen::Matrix<double, 6, 1> v = state.v.segment<6>(6 * i);
    energy.kinetic += 0.5 * v.dot(mass_matrix(blocks[block], pose.q_WB) * v);
    energy.potential -= blocks[block].mass * gravity.dot(pose.p_WB - blocks[block].centroid);
  }
  for (const PointLoad& load : model.loads.points) {
    const Pose& pose = state.poses[load.block];
    const Vec3 moved = pose.p_WB + pose.q_WB * load.p_BP_B - (blocks[load.block].centroid + load.p_BP_B);
    energy.potential -= model.loads.factor(load, state.time) * load.force.dot(moved);
  }
  CUPOLA_ASSERT(memories.values.size() == contacts.points.size());
  for (size_t i = 0; i < memories.values.size(); ++i) {
    const JointLaw law = joint_law(model, contacts, contacts.points[i], state.time);
    const ContactMemory& memory = memories.values[i];
    if (law.compliance_normal > 0.0)
      energy.elastic += 0.5 * memory.elastic_gap * memory.elastic_gap / law.compliance_normal;
    if (law.compliance_tangential > 0.0)
      energy.elastic += 0.5 * memory.elastic_slip_A.squaredNorm() / law.compliance_tangential;
  }
  for (const Tie& tie : model.ties) {
    const double stretch = std::min(0.0, tie_geometry(tie, state.poses).gap);
    energy.elastic += 0.5 * stretch * stretch / tie.compliance;
  }
  return energy;
}

double joint_dissipation(const StepProblem& step, const ContactSolution& solution) {
  const ContactProblem& problem = step.problem;
  const VecX y = relative_velocity(problem, solution.v) + problem.b + problem.E.cwiseProduct(solution.gamma);
  double work = 0.0;
  for (Eigen::Index i = 0; i < step.num_contacts; ++i)
    work -= solution.gamma.segment<2>(3 * i + 1).dot(y.segment<2>(3 * i + 1));
  if (problem.strength.empty()) return work;
  for (Eigen::Index i = 0; i < step.num_contacts; ++i)
    work += std::max(0.0, -solution.gamma[3 * i] * y[3 * i]);
  return work;
}

}  // namespace cupola
