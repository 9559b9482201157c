#include "solver/analysis/construction/stage_measures.hpp"

#include <algorithm>

#include "solver/analysis/construction/mortar_age.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/static_record.hpp"

namespace cupola {
namespace {

Eigen::Quaterniond turned_by(const Vec3& rotation) {
  const double angle = rotation.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();  // it has no axis
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

}  // namespace

Frame stage_frame(const Construction& building, const StaticSolution& solution) {
  const StageProblem& problem = building.problem();
  const BuiltState& state = building.state();
  Frame frame = static_frame(problem.model, problem.rest, problem.contacts, problem.memories, solution,
                             building.options());
  for (size_t block = 0; block < state.laid.size(); ++block) {
    frame.blocks.position[block] += state.displacement[block];
    frame.blocks.displacement[block] += state.displacement[block];
    const Eigen::Vector4d& q = frame.blocks.quaternion_wxyz[block];
    const Eigen::Quaterniond total =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * turned_by(state.rotation[block]);
    frame.blocks.quaternion_wxyz[block] = {total.w(), total.x(), total.y(), total.z()};
  }
  return frame;
}

double head_squeeze(const Construction& building, const StaticSolution& solution) {
  const BuildingSite& site = building.site();
  const BuiltState& state = building.state();
  const StagedConstruction& staged = site.scene.analysis.staged;
  const std::vector<int>& rows = building.problem().rows;
  double squeeze = 0.0;
  for (size_t k = 0; k < rows.size(); ++k) {
    const Contact& contact = site.contacts.points[rows[k]];
    const Patch& patch = site.contacts.patches[contact.patch];
    if (patch.kind != JointKind::head || !is_fresh(staged, std::max(0, state.ring - patch.course))) continue;
    const BuiltContact& joint = state.joints[rows[k]];
    const Vec3 u = relative_velocity(solution.step.problem, static_cast<int>(k), solution.step_solution.v);
    const double gap = joint.gap + solution.h * u[0];
    squeeze = std::max(squeeze, contact.gap + joint.hardened - gap);
  }
  return squeeze;
}

double largest_displacement(const Construction& building, const StaticSolution& solution) {
  const std::vector<Vec3>& before = building.state().displacement;
  double largest = 0.0;
  for (size_t block = 0; block < before.size(); ++block) {
    const int i = building.problem().model.free_index[block];
    const Vec3 moved = i == ContactProblem::kFixed
                           ? Vec3::Zero()
                           : Vec3(solution.h * solution.step_solution.v.segment<3>(6 * i));
    largest = std::max(largest, (before[block] + moved).norm());
  }
  return largest;
}

std::optional<LawViolation> violation_above(const std::optional<LawViolation>& worst,
                                            const Construction& building, const StaticSolution& solution,
                                            double time) {
  const ContactSet& contacts = building.problem().contacts;
  const std::vector<double> violations = static_violations(contacts, solution, building.options().solve.law);
  const auto largest = std::ranges::max_element(violations);
  if (largest == violations.end() || (worst && !(*largest > worst->value))) return std::nullopt;
  const auto i = static_cast<size_t>(largest - violations.begin());
  const Contact& contact = contacts.points[i];
  return LawViolation{*largest, number_joints(contacts).of_contact[i], contact.block_a, contact.block_b,
                      time};
}

}  // namespace cupola
