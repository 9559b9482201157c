#include "solver/dynamics/model.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "solver/dynamics/plane_scene.hpp"

namespace cupola {
namespace {

/// a x b = cross_matrix(a) b
Mat3 cross_matrix(const Vec3& a) {
  Mat3 A;
  A << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return A;
}

/// With the masses of point loads only where these move: a static step is as long as the blocks' own require.
std::vector<BodyMass> bodies_of(const Assembly& assembly, const LoadSet& loads, bool moving) {
  std::vector<BodyMass> bodies;
  for (const Block& block : assembly.blocks) bodies.push_back({block.mass, Vec3::Zero(), block.inertia});
  for (const PointLoad& load : loads.points) {
    if (!moving || load.mass == 0.0) continue;
    BodyMass& body = bodies[load.block];
    body.mass += load.mass;
    body.first_moment += load.mass * load.p_BP_B;
    body.inertia -= load.mass * cross_matrix(load.p_BP_B) * cross_matrix(load.p_BP_B);
  }
  return bodies;
}

}  // namespace

Model make_model(const Case& scene, const Assembly& assembly) {
  Model model;
  model.assembly = &assembly;
  int num_rings = 1;
  for (const Part& part : assembly.parts) num_rings = std::max(num_rings, part.ring + 1);
  model.joints = JointTable(scene.joints, num_rings);
  model.friction_time = scene.joints.friction_time;
  model.loads = make_loads(scene.loads, assembly);
  model.bodies = bodies_of(assembly, model.loads, scene.analysis.type == AnalysisType::dynamic);
  model.ties = make_ties(scene, assembly);
  model.ties_yield =
      std::ranges::any_of(model.ties, [](const Tie& tie) { return std::isfinite(tie.yield_force); });
  model.ground = make_ground_motion(scene);
  model.support_motions = make_support_motions(scene, assembly);
  model.heat = HeatedBlocks(scene, assembly);
  model.free_index.assign(assembly.blocks.size(), ContactProblem::kFixed);
  for (size_t block = 0; block < assembly.blocks.size(); ++block) {
    if (assembly.blocks[block].fixed) continue;
    model.free_index[block] = model.num_free();
    model.free_blocks.push_back(static_cast<int>(block));
  }
  model.free_weight = free_weight(assembly, scene.loads.gravity.norm());
  model.block_weight = model.num_free() > 0 ? model.free_weight / model.num_free() : 0.0;
  model.plane = scene.analysis.plane;
  if (model.plane)
    require_plane_scene(scene, assembly, {model.loads, model.ties, model.support_motions, model.heat});
  return model;
}

State seen_from_ground(const Model& model, const State& state, double h) {
  const Vec3 now = model.ground.displacement(state.time);
  const Vec3 velocity = (now - model.ground.displacement(state.time - h)) / h;
  State seen = state;
  for (Pose& pose : seen.poses) pose.p_WB -= now;
  seen.ground.setZero();
  for (int i = 0; i < model.num_free(); ++i) seen.v.segment<3>(6 * i) -= velocity;
  return seen;
}

State state_at_rest(const Model& model) {
  State state;
  state.poses.resize(model.assembly->blocks.size());
  for (size_t block = 0; block < state.poses.size(); ++block)
    state.poses[block].p_WB = model.assembly->blocks[block].centroid;
  state.v = VecX::Zero(6 * model.num_free());
  return state;
}

void move_supports(const Model& model, State* state) {
  place_supports(*model.assembly, model.support_motions, state->time, &state->poses);
  state->ground = model.ground.displacement(state->time);
}

const ContactSet& contacts_at_rest(const Model& model, ContactDetector* detector) {
  const State rest = state_at_rest(model);
  State moved = rest;
  move_supports(model, &moved);
  std::vector<double> travel(rest.poses.size(), 0.0);
  for (size_t b = 0; b < travel.size(); ++b)
    travel[b] = motion_bound(rest.poses[b], moved.poses[b], detector->block_radius(static_cast<int>(b)));
  return detector->update(rest.poses, travel);
}

std::vector<Vec3> displacements(const Assembly& assembly, const State& state) {
  std::vector<Vec3> displacement(state.poses.size());
  for (size_t block = 0; block < displacement.size(); ++block)
    displacement[block] = state.poses[block].p_WB - assembly.blocks[block].centroid;
  return displacement;
}

Mat6 mass_matrix(const BodyMass& body, const Eigen::Quaterniond& q_WB) {
  const Mat3 R_WB = q_WB.toRotationMatrix();
  const Mat3 moment = cross_matrix(R_WB * body.first_moment);
  Mat6 M;
  M << body.mass * Mat3::Identity(), -moment, moment, R_WB * body.inertia * R_WB.transpose();
  return M;
}

VecX applied_forces(const Model& model, const State& state, double time) {
  CUPOLA_ASSERT(state.v.size() == 6 * model.num_free());
  VecX f(6 * model.num_free());
  const Vec3 gravity = model.loads.gravity_at(time);
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Vec3 omega = state.v.segment<3>(6 * i + 3);
    const Mat3 R_WB = state.poses[block].q_WB.toRotationMatrix();
    const Mat3 I_W = R_WB * model.bodies[block].inertia * R_WB.transpose();
    f.segment<3>(6 * i) = model.assembly->blocks[block].mass * gravity -
                          omega.cross(omega.cross(R_WB * model.bodies[block].first_moment));
    f.segment<3>(6 * i + 3) = -omega.cross(I_W * omega);
  }
  for (const PointLoad& load : model.loads.points) {
    const int i = model.free_index[load.block];
    CUPOLA_ASSERT(i != ContactProblem::kFixed);
    const Vec3 force = model.loads.factor(load, time) * load.force;
    f.segment<3>(6 * i) += force;
    f.segment<3>(6 * i + 3) += (state.poses[load.block].q_WB * load.p_BP_B).cross(force);
  }
  return f;
}

double reference_acceleration(const Model& model, const State& state) {
  std::vector<Vec3> force(model.assembly->blocks.size(), Vec3::Zero());
  for (const PointLoad& load : model.loads.points)
    force[load.block] +=
        (load.time == PointForce::kDeadLoad ? 1.0 : model.loads.factor(load, state.time)) * load.force;
  const Vec3 gravity = model.loads.gravity + model.loads.pull;
  double acceleration = gravity.norm();
  for (int block : model.free_blocks) {
    const double mass = model.bodies[block].mass;
    const Vec3 per_mass = model.assembly->blocks[block].mass / mass * gravity + force[block] / mass;
    acceleration = std::max(acceleration, per_mass.norm());
  }
  return acceleration > 0.0 ? acceleration : 1.0;
}

void integrate_positions(const Model& model, double h, double time_advance, const VecX& v, State* state) {
  CUPOLA_ASSERT(v.size() == 6 * model.num_free());
  for (int i = 0; i < model.num_free(); ++i) {
    Pose& pose = state->poses[model.free_blocks[i]];
    pose.p_WB += h * v.segment<3>(6 * i);
    const Vec3 turn = h * v.segment<3>(6 * i + 3);
    const double angle = turn.norm();
    // A zero rotation has no axis.
    if (angle > 0.0)
      pose.q_WB = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) * pose.q_WB).normalized();
  }
  state->time += time_advance;
  move_supports(model, state);
}

JointLaw joint_law(const Model& model, const ContactSet& contacts, const Contact& contact, double time) {
  CUPOLA_ASSERT(contact.patch >= 0 && contact.patch < static_cast<int>(contacts.patches.size()));
  JointLaw law = model.joints.law(*model.assembly, contacts.patches[contact.patch], contact.area,
                                  contact.multiplicity, contact.closed_share);
  law.mu *= factor_at(model.friction_time, time);
  return law;
}

double tie_gap(const Model& model, const State& state, size_t k) {
  const TieGeometry now = tie_geometry(model.ties[k], state.poses, state.ground);
  if (model.heat.empty()) return now.gap;
  const Contact ends = as_contact(model.ties[k], now);
  return now.gap + now.normal.dot(model.heat.separation_before(state.poses, ends, state.time));
}

double largest_speed(const VecX& v) {
  double speed = 0.0;
  for (Eigen::Index i = 0; i < v.size(); i += 6) speed = std::max(speed, v.segment<3>(i).norm());
  return speed;
}

}  // namespace cupola
