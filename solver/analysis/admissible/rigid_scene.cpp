#include "solver/analysis/admissible/rigid_scene.hpp"

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/admissible/joint_extent.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/dynamics/law_violation.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

namespace {

/// Removes the points inside the faces of dry joints: a force there, within the cone about the normal, is the
/// sum of parallel forces at the corners. Faces that are not quite plane keep their points.
void keep_corners(ContactSet* contacts) {
  constexpr double kParallel = 1e-12;  // rounding of unit normals
  struct Face {
    int corners = 0, inner = 0;
    double area = 0.0;
    bool plane = true;
    Vec3 normal = Vec3::Zero();
  };
  std::vector<Face> faces(contacts->patches.size());
  for (const Contact& point : contacts->points) {
    Face& face = faces[point.patch];
    if (face.normal.isZero(0.0)) face.normal = point.normal;
    face.plane = face.plane && (point.normal - face.normal).norm() <= kParallel;
    ++(point.id.corner >= 0 ? face.corners : face.inner);
    face.area += point.area;
  }
  const auto is_reduced = [&](int patch) {
    return faces[patch].plane && faces[patch].inner > 0 &&
           faces[patch].corners == static_cast<int>(contacts->patches[patch].polygon.size());
  };
  std::erase_if(contacts->points,
                [&](const Contact& point) { return point.id.corner < 0 && is_reduced(point.patch); });
  for (Contact& point : contacts->points)
    if (is_reduced(point.patch)) point.area = faces[point.patch].area / faces[point.patch].corners;
}

/// Sets the components of axes and lever arms to zero that are rounding alone. Otherwise a tie through a
/// centroid would have to balance a moment of 1e-17 of its force, by which a rotation at 1e13 times the speed
/// of the tie would prove that it carries nothing. Friction resists such motions.
void remove_rounding(const std::vector<Pose>& poses, const Model& model, ContactProblem* problem) {
  constexpr double kRounding = 1e-15;  // a few units in the last place of the coordinates
  const auto clean = [&](int block, Lever* lever) {
    if (block == ContactProblem::kFixed) return;
    const double size =
        lever->arm.cwiseAbs().maxCoeff() + poses[model.free_blocks[block]].p_WB.cwiseAbs().maxCoeff();
    const auto round = [](Vec3 x, double small) {
      return (x.cwiseAbs().array() > small).select(x, Vec3::Zero()).eval();
    };
    lever->arm = round(lever->arm, kRounding * size);
    lever->frame.col(0) = round(lever->frame.col(0), kRounding);
  };
  for (int i = 0; i < problem->num_contacts(); ++i) {
    if (problem->mu[i] > 0.0) continue;
    clean(problem->block_a[i], &problem->D_a[i]);
    clean(problem->block_b[i], &problem->D_b[i]);
  }
}

/// The key that gives some joints no friction.
std::string key_without_friction(const Joints& joints) {
  if (joints.friction == 0.0) return "joints.friction";
  for (const auto& [key, law] : joints.kinds())
    if (law->friction == 0.0) return fmt::format("joints.{}.friction", key);
  return "the friction of joints.rings";
}

/// The shear that such a joint carries does not depend on its normal force: no cone.
void require_friction_with_cohesion(const ContactProblem& problem, const Case& scene) {
  using enum LimitSearch::Parameter;
  const Analysis& analysis = scene.analysis;
  const LimitSearch::Parameter sought = analysis.limit.parameter;
  const bool can_bisect =
      analysis.type == AnalysisType::limit && sought != joint_extent && sought != peak_stress;
  for (int i = 0; i < problem.num_contacts() && !problem.strength.empty(); ++i)
    if (problem.strength[i].cohesion > 0.0 && problem.mu[i] == 0.0)
      throw InputError(fmt::format(
          "joints.cohesion: ranges, robustness and direct limits require friction > 0 in joints "
          "with cohesion; give {}{}",
          key_without_friction(scene.joints), can_bisect ? ", or analysis.limit.method: bisection" : ""));
}

}  // namespace

RigidScene rigid_scene(const Case& scene, std::shared_ptr<const Assembly> assembly, double joint_extent,
                       bool all_points) {
  RigidScene rigid;
  rigid.assembly = std::move(assembly);
  rigid.model = make_model(scene, *rigid.assembly);
  rigid.start = state_at_rest(rigid.model);
  const DetectionOptions options = detection_options(scene);
  rigid.contacts = ContactDetector(*rigid.assembly, options).update(rigid.start.poses);
  const bool corners = !all_points && !scene.joints.have_strength();
  if (corners) keep_corners(&rigid.contacts);
  if (joint_extent != 1.0)
    rigid.open_in_part = scale_joints(*rigid.assembly, joint_extent,
                                      corners ? PatchSampling{} : options.sampling, &rigid.contacts);
  rigid.memories = match_memories({}, rigid.contacts.points);

  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  ConicProblem& problem = rigid.problem;
  problem.contacts =
      build_step_problem(rigid.model, rigid.start, rigid.contacts, rigid.memories, step).problem;
  remove_rounding(rigid.start.poses, rigid.model, &problem.contacts);
  require_friction_with_cohesion(problem.contacts, scene);
  problem.load = applied_forces(rigid.model, rigid.start, rigid.start.time);
  problem.cost = VecX::Zero(3 * problem.contacts.num_contacts());
  problem.load_columns = MatX(problem.load.size(), 0);
  problem.rows = MatX(problem.cost.size(), 0);
  return rigid;
}

Frame admissible_frame(const RigidScene& scene, const VecX& gamma, double time) {
  const ContactProblem& problem = scene.problem.contacts;
  VecX outside(problem.num_contacts());
  for (int i = 0; i < problem.num_contacts(); ++i) {
    outside[i] = limit_excess(contact_law(problem, i), gamma.segment<3>(3 * i));
  }
  JointForces forces = joint_forces(scene.contacts, gamma, VecX::Ones(gamma.size() / 3));
  remove_self_stress(scene.model.ties, &forces.ties);
  Frame frame = make_frame(scene.model, scene.start, scene.contacts, forces,
                           law_violations(scene.contacts, gamma, outside), scene.memories,
                           std::vector<Vec3>(scene.start.poses.size(), Vec3::Zero()));
  frame.time = time;
  set_role(FrameRole::equilibrium, "", &frame);
  return frame;
}

Equilibrium balance_of(const RigidScene& scene, const VecX& gamma) {
  return compute_equilibrium(scene.model, scene.start, scene.contacts,
                             joint_forces(scene.contacts, gamma, VecX::Ones(gamma.size() / 3)),
                             scene.start.time);
}

}  // namespace cupola
