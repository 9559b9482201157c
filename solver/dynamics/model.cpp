#include "solver/dynamics/model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/error.hpp"

namespace cupola {
namespace {

/// Spreads a weight over the top faces by area, as vertical forces at the face centroids. `down` is unit.
void add_top_load(const Assembly& assembly, double weight, const Vec3& down, const char* key,
                  std::vector<PointLoad>* loads) {
  struct TopFace {
    int block;
    Vec3 centroid;
    double area;
  };
  std::vector<TopFace> faces;
  double total_area = 0.0;
  for (const Part& part : assembly.parts) {
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] != FaceKind::top) continue;
      const std::vector<Vec3> polygon = face_points(assembly, f);
      faces.push_back({part.block, polygon_centroid(polygon), polygon_area(polygon)});
      total_area += faces.back().area;
    }
  }
  if (faces.empty())
    throw InputError(fmt::format("loads.{}: the assembly has no top faces to carry it", key));
  for (const TopFace& face : faces)
    loads->push_back({face.block, face.centroid - assembly.blocks[face.block].centroid,
                      weight * face.area / total_area * down});
}

}  // namespace

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
  const double g = model.gravity.norm();
  model.free_weight = free_weight(assembly, g);
  model.block_weight = model.num_free() > 0 ? model.free_weight / model.num_free() : 0.0;

  const Vec3 down = g > 0.0 ? Vec3(model.gravity / g) : Vec3(-Vec3::UnitZ());
  const auto add = [&](const std::optional<TopLoad>& load, const char* key) {
    if (load && load->weight_fraction > 0.0)
      add_top_load(assembly, load->weight_fraction * model.free_weight, down, key, &model.loads);
  };
  add(scene.loads.lantern, "lantern");
  add(scene.loads.top_load, "top_load");
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
