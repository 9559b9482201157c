#include "solver/analysis/construction/construction.hpp"

#include <stdexcept>
#include <utility>

#include "assembly/base/error.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/dynamics/joint_damage.hpp"

namespace cupola {
namespace {

bool pulls(const JointLaw& law) {
  return law.strength.tension > 0.0 && (law.mu == 0.0 || law.strength.cohesion > 0.0);
}

}  // namespace

Construction::Construction(const Case& scene, const Assembly& assembly,
                           const std::function<void(const std::string&)>& log)
    : site_(std::make_shared<BuildingSite>(scene, assembly)), options_(static_options(scene.analysis)) {
  options_.log = log;
  options_.follow_from_start = true;
  state_.laid.assign(assembly.blocks.size(), 0);
  for (size_t block = 0; block < assembly.blocks.size(); ++block)
    state_.laid[block] = assembly.blocks[block].fixed ? 1 : 0;
  state_.displacement.assign(assembly.blocks.size(), Vec3::Zero());
  state_.rotation = state_.displacement;
  const std::vector<Contact>& contacts = site_->contacts.points;
  state_.joints.resize(contacts.size());
  for (size_t i = 0; i < contacts.size(); ++i) state_.joints[i].gap = contacts[i].gap;
  state_.ties.resize(make_ties(scene, assembly).size());
}

void Construction::lay(const std::vector<int>& blocks, int ring) {
  if (!site_->scene.analysis.staged.carry) {
    state_.ring = ring;  // no joint has forces yet
  } else if (ring != state_.ring) {
    const Model before = stage_model(*site_, state_, {});
    state_.ring = ring;
    harden(before, stage_model(*site_, state_, {}));
  }
  for (const int block : blocks) state_.laid[block] = 1;
  state_.fresh.insert(state_.fresh.end(), blocks.begin(), blocks.end());
  place_beside_neighbours(blocks);
  if (site_->scene.supports.moving() && state_.complete()) move_supports();
}

/// For pictures: new blocks are where the blocks that they touch are.
void Construction::place_beside_neighbours(const std::vector<int>& blocks) {
  constexpr int kOld = -1;
  std::vector<int> count(state_.laid.size(), kOld);
  for (const int block : blocks) count[block] = 0;
  for (const Contact& contact : site_->contacts.points)
    for (const auto& [block, other] :
         {std::pair(contact.block_a, contact.block_b), std::pair(contact.block_b, contact.block_a)}) {
      if (count[block] == kOld || count[other] != kOld || !state_.laid[other]) continue;
      state_.displacement[block] += state_.displacement[other];
      ++count[block];
    }
  for (const int block : blocks)
    if (count[block] > 0) state_.displacement[block] /= count[block];
}

/// By their displacements at the time 0, which open, close and shear their joints and strain their ties, as in
/// statics to the first order of turns: so free blocks follow them.
void Construction::move_supports() {
  const std::vector<Pose> before = initial_poses(site_->assembly);
  std::vector<Pose> after = before;
  place_supports(site_->assembly, make_support_motions(site_->scene, site_->assembly), 0.0, &after);
  const auto velocity = block_velocities(before, after, 1.0);
  const auto moved = [&](int block, const Vec3& point) -> Vec3 {
    const Vec6 v = velocity.col(block);
    return v.head<3>() + v.tail<3>().cross(point - before[block].p_WB);
  };
  for (size_t i = 0; i < state_.joints.size(); ++i) {
    const Contact& c = site_->contacts.points[i];
    const Vec3 apart = moved(c.block_b, c.point_b) - moved(c.block_a, c.point_a);
    state_.joints[i].gap += apart.dot(c.normal);
    state_.joints[i].memory.elastic_slip_A += apart - apart.dot(c.normal) * c.normal;
  }
  const std::vector<Tie> ties = make_ties(site_->scene, site_->assembly);
  for (size_t k = 0; k < ties.size(); ++k) {
    const TieGeometry built = tie_geometry(ties[k], before, Vec3::Zero());  // no stage has restraints
    state_.ties[k].loosening +=
        built.normal.dot(moved(ties[k].block_b, built.point_b) - moved(ties[k].block_a, built.point_a));
  }
  for (size_t block = 0; block < before.size(); ++block) {
    state_.displacement[block] += velocity.col(static_cast<Eigen::Index>(block)).head<3>();
    state_.rotation[block] += velocity.col(static_cast<Eigen::Index>(block)).tail<3>();
  }
}

bool Construction::any_free() const {
  for (size_t block = 0; block < state_.laid.size(); ++block)
    if (state_.laid[block] && !site_->is_held(static_cast<int>(block), state_.ring)) return true;
  return false;
}

/// A joint keeps its force. Where the compliance changes, the elastic displacements that the force then causes
/// become part of its reference. A crack that opened without pull pulls once it opens further.
void Construction::harden(const Model& before, const Model& after) {
  const ContactSet& contacts = site_->contacts;
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const Contact& contact = contacts.points[i];
    const JointLaw old_law = joint_law(before, contacts, contact, 0.0);
    const JointLaw law = joint_law(after, contacts, contact, 0.0);
    BuiltContact& joint = state_.joints[i];
    if (pulls(law) && !pulls(old_law) && state_.laid[contact.block_a] && state_.laid[contact.block_b])
      begin_to_pull(joint.gap, &joint.memory.joint);
    if (law.compliance_normal == old_law.compliance_normal &&
        law.compliance_tangential == old_law.compliance_tangential)
      continue;
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

/// With the free blocks laid since, if others were part of it.
std::optional<NearbyStart> Construction::last_equilibrium() const {
  if (!site_->scene.analysis.staged.carry) return std::nullopt;
  std::vector<int> blocks;
  for (const int block : state_.fresh)
    if (const int i = problem_.model.free_index[block]; i != ContactProblem::kFixed) blocks.push_back(i);
  if (static_cast<int>(blocks.size()) == problem_.model.num_free()) return std::nullopt;
  return NearbyStart{std::move(blocks)};
}

/// None where these blocks are most of the structure: its own solve then takes hardly longer.
std::optional<StaticSolution> Construction::falling_part(const std::optional<double>& trial,
                                                         const StaticOptions& options) {
  constexpr int kShare = 2;
  problem_ = stage_problem(*site_, state_, trial, FreeBlocks::fresh);
  if (problem_.model.num_free() == 0 || kShare * problem_.model.num_free() > problem_.num_blocks)
    return std::nullopt;
  int solves = 0;
  StaticSolution solution =
      solve_breaking(problem_.model, problem_.rest, problem_.contacts, options, &problem_.memories, &solves);
  if (solution.outcome != StaticOutcome::moving || !solution.proven) return std::nullopt;
  return solution;
}

StaticSolution Construction::solve(const std::optional<double>& trial, Need need) {
  StaticOptions options = options_;
  if (trial && need == Need::verdict) options.tolerance = verdict_options(site_->scene.analysis).tolerance;
  if (need == Need::verdict)
    if (std::optional<StaticSolution> motion = falling_part(trial, options)) return std::move(*motion);
  problem_ = stage_problem(*site_, state_, trial, FreeBlocks::all);
  options.nearby = last_equilibrium();
  int solves = 0;
  return solve_breaking(problem_.model, problem_.rest, problem_.contacts, options, &problem_.memories,
                        &solves);
}

StaticSolution Construction::solve(Need need) {
  return solve(std::nullopt, need);
}

StaticSolution Construction::solve(double trial) {
  return solve(trial, Need::verdict);
}

StaticSolution Construction::solve_least(const Bracket& bracket) {
  const double least = bracket.stable.value;
  double value = least, step = value - bracket.moving.value;
  StaticSolution solution = solve(value, Need::forces);
  for (; solution.outcome != StaticOutcome::equilibrium && value + step <= 2.0 * least; step *= 2.0) {
    value += step;
    solution = solve(value, Need::forces);
  }
  return solution;
}

void Construction::accept(const StaticSolution& solution) {
  CUPOLA_ASSERT(solution.outcome == StaticOutcome::equilibrium);
  state_.fresh.clear();
  if (!site_->scene.analysis.staged.carry) return;
  ContactMemories& memories = problem_.memories;
  update_memories(problem_.model, solution.step, solution.step_solution, problem_.rest, problem_.contacts,
                  static_step_options(options_, solution.h), &memories);
  const VecX u = relative_velocity(solution.step.problem, solution.step_solution.v);
  for (size_t k = 0; k < problem_.rows.size(); ++k) {
    BuiltContact& joint = state_.joints[problem_.rows[k]];
    joint.memory = memories.of(k);
    joint.memory.impulse /= solution.h;
    joint.gap += solution.h * u[3 * static_cast<Eigen::Index>(k)];
  }
  for (size_t k = 0; k < problem_.ties.size(); ++k) {
    CarriedTie& tie = state_.ties[problem_.ties[k]];
    tie.memory = memories.ties[k];
    tie.memory.impulse /= solution.h;
    tie.loosening += solution.h * u[3 * static_cast<Eigen::Index>(problem_.rows.size() + k)];
  }
  for (int i = 0; i < problem_.model.num_free(); ++i) {
    const int block = problem_.model.free_blocks[i];
    state_.displacement[block] += solution.h * solution.step_solution.v.segment<3>(6 * i);
    state_.rotation[block] += solution.h * solution.step_solution.v.segment<3>(6 * i + 3);
  }
}

void Construction::restore(BuiltState state) {
  if (state.laid.size() != state_.laid.size() || state.joints.size() != state_.joints.size() ||
      state.ties.size() != state_.ties.size())
    throw std::runtime_error("does not fit the assembly");
  state_ = std::move(state);
}

}  // namespace cupola
