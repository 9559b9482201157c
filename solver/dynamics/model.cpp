#include "solver/dynamics/model.hpp"

#include <algorithm>

#include "assembly/applied_loads.hpp"

namespace cupola {

Model make_model(const Case& scene, const Assembly& assembly) {
  Model model;
  model.assembly = &assembly;
  model.joints = scene.joints;
  model.gravity = scene.loads.gravity;
  model.free_index.assign(assembly.blocks.size(), ContactProblem::kFixed);
  for (size_t block = 0; block < assembly.blocks.size(); ++block) {
    if (assembly.blocks[block].fixed) continue;
    model.free_index[block] = model.num_free();
    model.free_blocks.push_back(static_cast<int>(block));
  }
  model.free_weight = free_weight(assembly, model.gravity.norm());
  model.block_weight = model.num_free() > 0 ? model.free_weight / model.num_free() : 0.0;

  for (const PointForce& load : applied_loads(scene.loads, assembly))
    model.loads.push_back({load.block, load.point - assembly.blocks[load.block].centroid, load.force});
  return model;
}

State state_at_rest(const Model& model) {
  State state;
  state.poses.resize(model.assembly->blocks.size());
  for (size_t block = 0; block < state.poses.size(); ++block)
    state.poses[block].p_WB = model.assembly->blocks[block].centroid;
  state.v = VecX::Zero(6 * model.num_free());
  return state;
}

Mat6 mass_matrix(const Block& block, const Eigen::Quaterniond& q_WB) {
  const Mat3 R_WB = q_WB.toRotationMatrix();
  Mat6 M = Mat6::Zero();
  M.topLeftCorner<3, 3>() = block.mass * Mat3::Identity();
  M.bottomRightCorner<3, 3>() = R_WB * block.inertia * R_WB.transpose();
  return M;
}

VecX applied_forces(const Model& model, const State& state) {
  VecX f(6 * model.num_free());
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Vec3 omega = state.v.segment<3>(6 * i + 3);
    const Mat3 R_WB = state.poses[block].q_WB.toRotationMatrix();
    const Mat3 I_W = R_WB * model.assembly->blocks[block].inertia * R_WB.transpose();
    f.segment<3>(6 * i) = model.assembly->blocks[block].mass * model.gravity;
    f.segment<3>(6 * i + 3) = -omega.cross(I_W * omega);
  }
  for (const PointLoad& load : model.loads) {
    const int i = model.free_index[load.block];
    if (i == ContactProblem::kFixed) continue;
    f.segment<3>(6 * i) += load.force;
    f.segment<3>(6 * i + 3) += (state.poses[load.block].q_WB * load.p_BP_B).cross(load.force);
  }
  return f;
}

double reference_acceleration(const Model& model, const State& state) {
  const VecX f = applied_forces(model, state);
  double acceleration = model.gravity.norm();
  for (int i = 0; i < model.num_free(); ++i) {
    const double mass = model.assembly->blocks[model.free_blocks[i]].mass;
    acceleration = std::max(acceleration, f.segment<3>(6 * i).norm() / mass);
  }
  return acceleration;
}

void integrate_positions(const Model& model, double h, State* state) {
  for (int i = 0; i < model.num_free(); ++i) {
    Pose& pose = state->poses[model.free_blocks[i]];
    pose.p_WB += h * state->v.segment<3>(6 * i);
    const Vec3 turn = h * state->v.segment<3>(6 * i + 3);
    const double angle = turn.norm();
    // exp of a zero rotation has no axis; the identity is its limit.
    if (angle > 0.0)
      pose.q_WB = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) * pose.q_WB).normalized();
  }
}

JointLaw joint_law(const Model& model, const Contact& contact) {
  const Compliance& c = model.joints.compliance;
  const double per = c.per == Compliance::Per::area ? 1.0 / contact.area : 1.0;
  return {model.joints.friction, c.normal * per, c.tangential * per};
}

}  // namespace cupola
