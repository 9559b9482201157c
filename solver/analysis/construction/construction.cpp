#include "solver/analysis/construction/construction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assembly/base/error.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/stages.hpp"

namespace cupola {
namespace {

Eigen::Quaterniond turned_by(const Vec3& rotation) {
  const double angle = rotation.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();  // it has no axis
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

/// Sets the property of fresh mortar that a search varies.
void set_fresh(StagedConstruction* staged, double value) {
  const bool friction = staged->least == StagedConstruction::Least::friction;
  if (staged->curing.empty()) {
    (friction ? staged->fresh.friction : staged->fresh.cohesion) = value;
  } else {
    JointLawChange& law = staged->curing.front().law;
    (friction ? law.friction : law.cohesion) = value;
  }
}

void require_carried(const Case& scene) {
  if (scene.supports.moving())
    throw InputError("analysis.staged: supports.moves is not part of the stages of construction; remove it");
  if (!scene.ties.pairs.empty() || !scene.geometry.chains.empty())
    throw InputError(
        "analysis.staged: ties and chains require unit: ring without carry, least, curing and hold_below");
}

}  // namespace

Construction::Construction(const Case& scene, const Assembly& assembly,
                           const std::function<void(const std::string&)>& log)
    : scene_(scene), assembly_(assembly), options_(static_options(scene.analysis)) {
  require_carried(scene);
  if (!assembly.ties.empty()) throw InputError("analysis.staged: ties of the assembly require unit: ring");
  options_.log = log;
  options_.follow_from_start = true;
  complete_ = ContactDetector(assembly, detection_options(scene)).update(initial_poses(assembly));
  // A joint with a support is as old as its free block.
  for (Patch& patch : complete_.patches)
    if (patch.kind == JointKind::base)
      patch.ring = std::max(assembly.blocks[patch.block_a].ring, assembly.blocks[patch.block_b].ring);
  state_.laid.assign(assembly.blocks.size(), 0);
  for (size_t block = 0; block < assembly.blocks.size(); ++block)
    state_.laid[block] = assembly.blocks[block].fixed ? 1 : 0;
  state_.displacement.assign(assembly.blocks.size(), Vec3::Zero());
  state_.rotation = state_.displacement;
  state_.joints.resize(complete_.points.size());
  for (size_t i = 0; i < complete_.points.size(); ++i) state_.joints[i].gap = complete_.points[i].gap;
}

bool Construction::is_held(int block) const {
  const Block& b = assembly_.blocks[block];
  const int below = scene_.analysis.staged.hold_below;
  return b.fixed || (below >= 0 && b.ring < ring_ - below);
}

bool Construction::is_complete() const {
  return std::ranges::all_of(state_.laid, [](char laid) { return laid == 1; });
}

/// The complete scene with the mortar of this stage, whose free blocks are those that are solved.
Model Construction::model_at(std::optional<double> trial) const {
  Case at = scene_;
  StagedConstruction staged = scene_.analysis.staged;
  if (trial) set_fresh(&staged, *trial);
  add_fresh_joints(staged, ring_, std::numeric_limits<int>::max(), &at.joints);
  if (!is_complete()) {
    at.loads = Loads{};
    at.loads.gravity = scene_.loads.gravity;
  }
  Model model = make_model(at, assembly_);
  std::erase_if(model.free_blocks, [&](int block) { return !state_.laid[block] || is_held(block); });
  model.free_index.assign(assembly_.blocks.size(), ContactProblem::kFixed);
  model.free_weight = 0.0;
  for (int i = 0; i < model.num_free(); ++i) {
    model.free_index[model.free_blocks[i]] = i;
    model.free_weight += assembly_.blocks[model.free_blocks[i]].mass * scene_.loads.gravity.norm();
  }
  model.block_weight = model.num_free() > 0 ? model.free_weight / model.num_free() : 0.0;
  std::erase_if(model.loads.points, [&](const PointLoad& load) {
    return model.free_index[load.block] == ContactProblem::kFixed;
  });
  return model;
}

void Construction::build_problem(std::optional<double> trial) {
  problem_ = {model_at(trial), {}, {}, {}, {}};
  problem_.rest = state_at_rest(problem_.model);
  problem_.contacts.patches = complete_.patches;
  problem_.memories.as_built = false;
  const auto is_free = [&](int block) { return problem_.model.free_index[block] != ContactProblem::kFixed; };
  for (size_t i = 0; i < complete_.points.size(); ++i) {
    Contact contact = complete_.points[i];
    if (!state_.laid[contact.block_a] || !state_.laid[contact.block_b]) continue;
    if (!is_free(contact.block_a) && !is_free(contact.block_b)) continue;
    const BuiltContact& joint = state_.joints[i];
    contact.gap = joint.gap;
    problem_.rows.push_back(static_cast<int>(i));
    problem_.contacts.points.push_back(contact);
    problem_.memories.ids.push_back(contact.id);
    problem_.memories.values.push_back(joint.memory);
  }
}

void Construction::lay(const std::vector<int>& blocks, int ring) {
  constexpr int kOld = -1;
  if (ring != ring_) {
    const Model before = model_at(std::nullopt);
    ring_ = ring;
    harden(before, model_at(std::nullopt));
  }
  for (const int block : blocks) state_.laid[block] = 1;
  new_.insert(new_.end(), blocks.begin(), blocks.end());
  // For pictures: where the blocks that it touches are.
  std::vector<int> count(state_.laid.size(), kOld);
  for (const int block : blocks) count[block] = 0;
  for (const Contact& contact : complete_.points)
    for (const auto& [block, other] :
         {std::pair(contact.block_a, contact.block_b), std::pair(contact.block_b, contact.block_a)}) {
      if (count[block] == kOld || count[other] != kOld || !state_.laid[other]) continue;
      state_.displacement[block] += state_.displacement[other];
      ++count[block];
    }
  for (const int block : blocks)
    if (count[block] > 0) state_.displacement[block] /= count[block];
}

bool Construction::any_free() const {
  for (size_t block = 0; block < state_.laid.size(); ++block)
    if (state_.laid[block] && !is_held(static_cast<int>(block))) return true;
  return false;
}

/// A joint whose compliance changes keeps its forces: the elastic displacements that they cause with the new
/// compliance become part of its reference.
void Construction::harden(const Model& before, const Model& after) {
  for (size_t i = 0; i < complete_.points.size(); ++i) {
    const Contact& contact = complete_.points[i];
    const JointLaw old_law = joint_law(before, complete_, contact, 0.0);
    const JointLaw law = joint_law(after, complete_, contact, 0.0);
    if (law.compliance_normal == old_law.compliance_normal &&
        law.compliance_tangential == old_law.compliance_tangential)
      continue;
    BuiltContact& joint = state_.joints[i];
    const Vec3 force = joint.memory.impulse;
    const double change = -law.compliance_normal * force[0] - joint.memory.elastic_gap;
    if (force[0] != 0.0) {
      joint.memory.elastic_gap += change;
      joint.gap += change;
      joint.hardened += change;
    }
    const Vec3 slip_C = -law.compliance_tangential * Vec3(0.0, force[1], force[2]);
    joint.memory.elastic_slip_A = contact_frame(contact.normal) * slip_C;
  }
}

/// The free blocks laid since the last equilibrium, if others were part of it.
std::optional<std::vector<int>> Construction::new_blocks() const {
  if (!scene_.analysis.staged.carry) return std::nullopt;
  std::vector<int> blocks;
  for (const int block : new_)
    if (const int i = problem_.model.free_index[block]; i != ContactProblem::kFixed) blocks.push_back(i);
  if (static_cast<int>(blocks.size()) == problem_.model.num_free()) return std::nullopt;
  return blocks;
}

StaticSolution Construction::solve(std::optional<double> trial) {
  build_problem(trial);
  StaticOptions options = options_;
  if (trial) options.tolerance = verdict_options(scene_.analysis).tolerance;
  options.new_blocks = new_blocks();
  int solves = 0;
  return solve_breaking(problem_.model, problem_.rest, problem_.contacts, options, &problem_.memories,
                        &solves);
}

void Construction::accept(const StaticSolution& solution) {
  CUPOLA_ASSERT(solution.outcome == StaticOutcome::equilibrium);
  if (!scene_.analysis.staged.carry) return;
  new_.clear();
  ContactMemories memories = problem_.memories;
  update_memories(problem_.model, solution.step, solution.step_solution, problem_.rest, problem_.contacts,
                  static_step_options(options_, solution.h), &memories);
  const VecX u =
      relative_velocity(solution.step.problem, solution.step_solution.v) + solution.step.support_velocity;
  for (size_t k = 0; k < problem_.rows.size(); ++k) {
    BuiltContact& joint = state_.joints[problem_.rows[k]];
    joint.memory = memories.values[k];
    joint.memory.impulse /= solution.h;
    joint.gap += solution.h * u[3 * static_cast<Eigen::Index>(k)];
  }
  for (int i = 0; i < problem_.model.num_free(); ++i) {
    const int block = problem_.model.free_blocks[i];
    state_.displacement[block] += solution.h * solution.step_solution.v.segment<3>(6 * i);
    state_.rotation[block] += solution.h * solution.step_solution.v.segment<3>(6 * i + 3);
  }
}

double Construction::head_squeeze(const StaticSolution& solution) const {
  const VecX u = relative_velocity(solution.step.problem, solution.step_solution.v);
  double squeeze = 0.0;
  for (size_t k = 0; k < problem_.rows.size(); ++k) {
    const int row = problem_.rows[k];
    const Patch& patch = complete_.patches[complete_.points[row].patch];
    if (patch.kind != JointKind::head || patch.ring <= ring_ - scene_.analysis.staged.fresh.courses) continue;
    const BuiltContact& joint = state_.joints[row];
    const double gap = joint.gap + solution.h * u[3 * static_cast<Eigen::Index>(k)];
    squeeze = std::max(squeeze, complete_.points[row].gap + joint.hardened - gap);
  }
  return squeeze;
}

double Construction::displacement(const StaticSolution& solution) const {
  double largest = 0.0;
  for (size_t block = 0; block < state_.displacement.size(); ++block) {
    const int i = problem_.model.free_index[block];
    const Vec3 moved = i == ContactProblem::kFixed
                           ? Vec3::Zero()
                           : Vec3(solution.h * solution.step_solution.v.segment<3>(6 * i));
    largest = std::max(largest, (state_.displacement[block] + moved).norm());
  }
  return largest;
}

std::optional<LawViolation> Construction::violation_above(const std::optional<LawViolation>& worst,
                                                          const StaticSolution& solution, double time) const {
  const std::vector<double> violations = static_violations(problem_.contacts, solution, options_.solve.law);
  const auto largest = std::ranges::max_element(violations);
  if (largest == violations.end() || (worst && !(*largest > worst->value))) return std::nullopt;
  const auto i = static_cast<size_t>(largest - violations.begin());
  const Contact& contact = problem_.contacts.points[i];
  return LawViolation{*largest, number_joints(problem_.contacts).of_contact[i], contact.block_a,
                      contact.block_b, time};
}

Frame Construction::frame(const StaticSolution& solution) const {
  Frame frame =
      static_frame(problem_.model, problem_.rest, problem_.contacts, problem_.memories, solution, options_);
  for (size_t block = 0; block < assembly_.blocks.size(); ++block) {
    frame.blocks.position[block] += state_.displacement[block];
    frame.blocks.displacement[block] += state_.displacement[block];
    const Eigen::Vector4d& q = frame.blocks.quaternion_wxyz[block];
    const Eigen::Quaterniond total =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * turned_by(state_.rotation[block]);
    frame.blocks.quaternion_wxyz[block] = {total.w(), total.x(), total.y(), total.z()};
  }
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.kind[i] == JointKind::base) frame.contacts.ring[i] = 0;  // as the file format says
  return frame;
}

void Construction::restore(BuiltState state, int ring) {
  if (state.laid.size() != state_.laid.size() || state.joints.size() != state_.joints.size())
    throw std::runtime_error("does not fit the assembly");
  state_ = std::move(state);
  ring_ = ring;
}

}  // namespace cupola
