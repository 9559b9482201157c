#include <algorithm>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/base/error.hpp"
#include "solver/dynamics/joint_damage.hpp"
#include "solver/dynamics/time_step.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

KnownMotion known_motion(const StepProblem& step, int i, const VecX& v, const StepOptions& options) {
  const Integrator& scheme = options.integrator;
  KnownMotion known;
  if (scheme.is_euler()) return known;
  const double h = options.h;
  const Vec3 u = relative_velocity(step.problem, i, v);
  known.to_middle = scheme.middle * h * u;
  known.rest = (scheme.v_start - scheme.middle) * h * u +
               scheme.a * h * h * relative_velocity(step.problem, i, step.acceleration);
  return known;
}

State middle_of_step(const Model& model, const State& state, const StepOptions& options) {
  if (options.integrator.is_euler()) return state;
  State middle = state;
  integrate_positions(model, options.integrator.middle * options.h, 0.0, state.v, &middle);
  return middle;
}

VecX mean_velocity(const StepProblem& step, const State& state, const ContactSolution& solution,
                   const StepOptions& options) {
  if (options.integrator.is_euler()) return solution.v;
  const Integrator& scheme = options.integrator;
  return scheme.v_start * state.v + scheme.v_end * solution.v + scheme.a * options.h * step.acceleration;
}

namespace {

/// Where a contact stands at the ends of a step.
struct StepEnds {
  double approach = 0.0;  ///< m, in a step at the speed at the start, less the compression of its spring
  double gap = 0.0;       ///< m, at the end
};

/// What the generalized alpha method keeps of a contact, and the penetration that an impact leaves. `moved`:
/// m, by the loads in a step from rest. Returns whether the contact has met.
bool update_past(const Vec3& force_A, const StepEnds& ends, double moved, const StepOptions& options,
                 ContactMemory* memory) {
  const double gap = ends.gap;
  const Integrator& scheme = options.integrator;
  const bool smooth = has_past(*memory, options);
  memory->filtered_A =
      smooth ? Vec3((scheme.end * force_A + scheme.start * memory->force_A) / (scheme.end + scheme.start))
             : force_A;
  memory->force_A = force_A;
  const bool loaded = memory->impulse[0] > 0.0;
  if (!loaded)
    memory->rest_gap = std::min(0.0, std::max(memory->rest_gap, gap));
  else if (!smooth)
    memory->rest_gap = std::min(0.0, gap - memory->elastic_gap);
  const bool met = !smooth && ends.approach > moved;
  memory->loaded_steps = loaded ? memory->loaded_steps + 1 : 0;
  return loaded && met;
}

/// The force of an impact is no force from which the next step could go on, neither of the contacts that have
/// `met` (nc) nor of those through which the impact passes.
void end_past_at_impacts(const ContactProblem& problem, const std::vector<char>& met,
                         std::vector<ContactMemory>* values) {
  if (std::ranges::count(met, 1) == 0) return;
  const auto first_free = [&](size_t i) { return std::max(problem.block_a[i], problem.block_b[i]); };
  DisjointSets loaded(problem.num_blocks());
  for (size_t i = 0; i < met.size(); ++i)
    if ((*values)[i].loaded_steps > 0 && std::min(problem.block_a[i], problem.block_b[i]) >= 0)
      loaded.join(problem.block_a[i], problem.block_b[i]);
  std::vector<char> reached(problem.num_blocks(), 0);  // by the first block of a set
  for (size_t i = 0; i < met.size(); ++i)
    if (met[i]) reached[loaded.root(first_free(i))] = 1;
  for (size_t i = 0; i < met.size(); ++i)
    if (reached[loaded.root(first_free(i))])
      (*values)[i].loaded_steps = std::min((*values)[i].loaded_steps, 1);
}

/// What the ties carry from step to step.
void update_ties(const StepProblem& step, const ContactSolution& solution, std::vector<TieMemory>* ties) {
  for (size_t k = 0; k < ties->size(); ++k) {
    const int row = step.num_contacts + static_cast<int>(k);
    (*ties)[k].impulse = solution.gamma[3 * row];
    (*ties)[k].yielded += plastic_elongation(step, row, solution);
  }
}

}  // namespace

void update_memories(const Model& model, const StepProblem& step, const ContactSolution& solution,
                     const State& state, const ContactSet& contacts, const StepOptions& options,
                     ContactMemories* memories) {
  const ContactProblem& problem = step.problem;
  CUPOLA_ASSERT(solution.gamma.size() == 3 * problem.num_contacts());
  CUPOLA_ASSERT(static_cast<int>(memories->ids.size()) == step.num_contacts);
  const VecX u = step.with_supports(relative_velocity(problem, solution.v));
  const double h = options.reach();
  std::vector<ContactMemory>& values = memories->stored();
  const double moved = options.h * options.h * reference_acceleration(model, state);
  std::vector<char> met(step.num_contacts, 0);  // in this step; of the generalized alpha method
  const auto update = [&](int i) {
    const Contact& contact = contacts.points[i];
    ContactMemory& memory = values[i];
    const Mat3 R_WC = contact_frame(contact.normal);
    const double rest = known_motion(step, i, state.v, options).rest[0];
    const double speed = relative_velocity(problem, i, state.v)[0] + step.support_velocity_of(i)[0];
    const double approach = memory.elastic_gap - options.h * speed;
    const Vec3 gamma = solution.gamma.segment<3>(3 * i);
    const Vec3 b = problem.b.segment<3>(3 * i) - step.support_velocity_of(i);
    const Vec3 u_el = -(b + problem.E.segment<3>(3 * i).cwiseProduct(gamma));
    memory.impulse = gamma;
    memory.tangent_A = state.poses[contact.block_a].q_WB.conjugate() * R_WC.col(1);
    memory.point_A = place_on(state.poses[contact.block_a], contact);
    const double elastic_gap = b[0] * options.reach_of(b[0], memory.elastic_gap) + h * u_el[0];
    const bool is_pulled = gamma[0] < 0.0 && model.joints.has_strength();
    memory.elastic_gap = is_pulled         ? std::max(0.0, elastic_gap)
                         : gamma[0] <= 0.0 ? 0.0
                                           : std::min(0.0, elastic_gap);
    const bool carries_shear =
        gamma[0] > 0.0 || (model.joints.has_strength() && !gamma.tail<2>().isZero(0.0));
    const Eigen::Vector2d z_t = u.segment<2>(3 * i + 1) - u_el.tail<2>();
    const Eigen::Vector2d rate = rate_of_spring(step, i, u.segment<2>(3 * i + 1), z_t, state.v, options);
    const Eigen::Vector2d relaxed = options.damping * (u_el.tail<2>() - rate);
    memory.plastic_slip += carries_shear ? (h * z_t - relaxed).norm() : 0.0;
    if (model.joints.has_strength())
      add_inelastic_displacement(joint_law(model, contacts, contact, state.time + options.advance()),
                                 h * (u.segment<3>(3 * i) - u_el), gamma, &memory.joint);

    Vec3 slip_C = Vec3(0.0, b[1], b[2]) * (h + options.damping) + h * Vec3(0.0, u_el[1], u_el[2]);
    slip_C.tail<2>() += relaxed;
    memory.elastic_slip_A = state.poses[contact.block_a].q_WB.conjugate() * (R_WC * slip_C);
    if (options.tangential == TangentialSpring::literal) memory.elastic_slip_A.setZero();
    if (options.integrator.is_euler()) return;
    const Vec3 force_C = gamma / step.impulse_time[i];
    met[i] = update_past(state.poses[contact.block_a].q_WB.conjugate() * (R_WC * force_C),
                         {approach, contact.gap + rest + h * u[3 * i]}, moved, options, &memory);
  };
  constexpr double kOperationsPerContact = 200.0;
  share_range(kOperationsPerContact * step.num_contacts, step.num_contacts, [&](int first, int last) {
    for (int i = first; i < last; ++i) update(i);
  });
  end_past_at_impacts(problem, met, &values);
  memories->ties.resize(model.ties.size());
  update_ties(step, solution, &memories->ties);
}

double plastic_elongation(const StepProblem& step, int row, const ContactSolution& solution) {
  // Below the yield force the contact law is satisfied up to the accuracy of the solve, which must not add up
  // over the steps.
  constexpr double kYields = 1e-6;
  if (step.problem.strength.empty()) return 0.0;
  const double limit = step.problem.strength[row].compression;
  if (solution.gamma[3 * row] < (1.0 - kYields) * limit) return 0.0;
  return std::max(0.0, -step.reach * inelastic_velocity(step.problem, row, solution)[0]);
}

void continue_from_rest(const Vec3& force, const Pose& pose_a, ContactMemory* memory) {
  memory->force_A = memory->filtered_A = pose_a.q_WB.conjugate() * force;
  memory->loaded_steps = memory->impulse[0] > 0.0 ? kSmooth : 0;
}

Vec3 in_present_frame(const ContactMemory& memory, const Contact& contact, const State& state) {
  constexpr double kSameTangent = 0.75;  // cos; blocks turn by far less in a step
  const Vec3 tangent_W = state.poses[contact.block_a].q_WB * memory.tangent_A;
  const Vec3 tangent_C = contact_frame(contact.normal).transpose() * tangent_W;
  const Eigen::Vector2d t = tangent_C.tail<2>().normalized();
  if (t.isZero(0.0) || t[0] > kSameTangent) return memory.impulse;
  const Vec3& old = memory.impulse;
  return {old[0], old[1] * t[0] - old[2] * t[1], old[1] * t[1] + old[2] * t[0]};
}

ContactSolution warm_start(const StepProblem& step, const State& state, const ContactSet& contacts,
                           const ContactMemories& memories) {
  CUPOLA_ASSERT(static_cast<int>(memories.ids.size()) == step.num_contacts);
  ContactSolution guess;
  guess.v = state.v;
  guess.gamma = VecX::Zero(step.problem.b.size());
  constexpr double kOperationsPerContact = 100.0;
  share_sums(kOperationsPerContact * step.num_contacts, step.num_contacts, [&](int first, int last) {
    for (int i = first; i < last; ++i)
      guess.gamma.segment<3>(3 * i) = in_present_frame(memories.of(i), contacts.points[i], state);
  });
  for (size_t k = 0; k < memories.ties.size(); ++k)
    guess.gamma[3 * (step.num_contacts + static_cast<int>(k))] = memories.ties[k].impulse;
  return guess;
}

}  // namespace cupola
