#include "solver/dynamics/energy_account.hpp"

#include <algorithm>

#include "assembly/base/error.hpp"
#include "solver/dynamics/energy.hpp"
#include "solver/dynamics/joint_damage.hpp"
#include "solver/runtime/ordered_sum.hpp"

namespace cupola {
namespace {

constexpr double kAccountOperationsPerContact = 50.0;

/// m/N of a row: E = c / (impulse_time (reach + alpha)).
double compliance(const StepProblem& step, Eigen::Index row, const StepOptions& options) {
  return step.problem.E[row] * step.impulse_time[row / 3] * options.damped_reach();
}

std::vector<double> spring_energies(const StepProblem& step, const ContactMemories& memories,
                                    const StepOptions& options) {
  const auto nc = static_cast<int>(memories.ids.size());
  std::vector<double> energies(memories.ids.size(), 0.0);
  share_sums(kAccountOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const Eigen::Index row = 3 * i;
      const ContactMemory& memory = memories.of(i);
      const double normal = compliance(step, row, options), tangential = compliance(step, row + 1, options);
      if (normal > 0.0) energies[i] += 0.5 * memory.elastic_gap * memory.elastic_gap / normal;
      if (tangential > 0.0) energies[i] += 0.5 * memory.elastic_slip_A.squaredNorm() / tangential;
    }
  });
  return energies;
}

/// J, of the viscous part of a row that carries a force and whose spring is stretched at the speed `rate` for
/// all of the step.
double damping_work(const StepProblem& step, Eigen::Index row, double rate, const StepOptions& options) {
  const double c = compliance(step, row, options);
  return c > 0.0 ? options.damping * options.h * rate * rate / c : 0.0;
}

/// m/s, u_el of a contact or tie without the part by which it crosses its gap, which stretches no spring.
Vec3 stretching(const StepProblem& step, int row, Vec3 u_el, double elastic_gap) {
  const double b_n = step.problem.b[3 * row] - step.support_velocity_of(row)[0];
  if (elastic_gap <= 0.0) u_el[0] += std::max(0.0, b_n);
  return u_el;
}

/// Work of the contacts and ties: what the joints dissipate, and the springs beyond what they store.
void add_joint_work(const Model& model, const StepStart& start, const StepProblem& step,
                    const ContactSolution& solution, const State& state, const ContactMemories& memories,
                    const StepOptions& options, StepWork* work) {
  const ContactProblem& problem = step.problem;
  const VecX u = relative_velocity(problem, solution.v), u_start = relative_velocity(problem, start.state.v);
  const double share = step.reach / options.h;  // of the velocity of supports in its mean over the step
  VecX mean = 0.5 * (u + u_start);
  if (step.support_velocity.size() > 0) mean += share * step.support_velocity;
  const VecX z = u + problem.b + problem.E.cwiseProduct(solution.gamma);
  const VecX u_el = step.with_supports(u - z);
  const VecX p = step.past_impulse.size() > 0 ? VecX(solution.gamma + step.past_impulse) : solution.gamma;
  const std::vector<double> springs = spring_energies(step, memories, options);
  work->supports = step.support_velocity.size() > 0 ? -share * p.dot(step.support_velocity) : 0.0;
  const double moved = options.h * options.h * reference_acceleration(model, state);  // as update_memories()
  const int nc = step.num_contacts;
  *work = sum_in_order(kAccountOperationsPerContact * nc, nc, *work, [&](int i) {
    const Eigen::Index row = 3 * i;
    const Vec3 gamma = solution.gamma.segment<3>(row);
    const Eigen::Vector2d z_t = z.segment<2>(row + 1), u_t = u_el.segment<2>(row + 1) + z_t;
    const Eigen::Vector2d rate_t = rate_of_spring(step, i, u_t, z_t, start.state.v, options);
    Vec3 inelastic = step.reach * z.segment<3>(row);  // as update_memories()
    inelastic.tail<2>() -= options.damping * (u_el.segment<2>(row + 1) - rate_t);
    const JointWork joint = joint_work(step, i, gamma, inelastic);
    const Vec3 rate = stretching(step, i, u_el.segment<3>(row), start.elastic_gap[i]);
    Vec3 damped = rate;
    damped.tail<2>() = rate_t;
    const double taken = -p.segment<3>(row).dot(mean.segment<3>(row));
    const double stored = springs[i] - start.springs[i];
    const double approach_per_step = options.h * (u_start[row] + share * step.support_velocity_of(i)[0]);
    StepWork term;
    const double dissipated = joint.slip + joint.breaking;
    term.friction = dissipated;
    term.dilatancy = joint.dilatancy;
    for (int k = 0; k < 3 && !gamma.isZero(0.0); ++k)
      term.damping += damping_work(step, row + k, damped[k], options);
    // A spring that no force compresses expands against its damper.
    if (gamma.isZero(0.0) && options.damping > 0.0) term.damping = -stored;
    if (gamma[0] > 0.0 && start.elastic_gap[i] - approach_per_step > moved)
      term.impact =
          taken - dissipated + joint.dilatancy + step.reach / step.impulse_time[i] * gamma.dot(rate);
    term.scheme = taken + joint.dilatancy - dissipated - term.damping - term.impact - stored;
    return term;
  });
  for (int tie = step.num_contacts; tie < problem.num_contacts(); ++tie) {
    const Eigen::Index row = 3 * tie;
    const double rate = stretching(step, tie, u_el.segment<3>(row), 0.0)[0];
    const double damping = solution.gamma[row] == 0.0 ? 0.0 : damping_work(step, row, rate, options);
    const double yielding = yield_work(step, tie, solution);
    work->damping += damping;
    work->friction += yielding;
    work->scheme -= p[row] * mean[row] + damping + yielding;
  }
  work->scheme -= tie_energy(model, state, memories) - start.ties;
}

/// Work of inertia and loads.
void add_motion_work(const Model& model, const StepStart& start, const StepProblem& step,
                     const ContactSolution& solution, const State& state, const StepOptions& options,
                     StepWork* work) {
  const double first = start.state.time, middle = first + options.load_advance(), last = state.time;
  const auto potential = [&model](const State& at, double time) {
    return potential_energy(model, at.poses, time);
  };
  const double rise_before = potential(start.state, middle) - potential(start.state, first);
  const double rise_after = potential(state, last) - potential(state, middle);
  work->loads = rise_before + rise_after;

  // What the loads h f give to the mean velocity beyond the potential energy, and the inertia that turns.
  double gained = potential(state, middle) - potential(start.state, middle);
  const VecX mean = 0.5 * (start.state.v + solution.v);
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Mat6& M = step.problem.M[i];
    const auto turned = [&](const State& at, const VecX& v) {
      const Mat6 now = mass_matrix(model.bodies[block], at.poses[block].q_WB);
      return 0.5 * v.segment<6>(6 * i).dot((now - M) * v.segment<6>(6 * i));
    };
    gained += mean.segment<6>(6 * i).dot(
        M * (step.problem.v_star.segment<6>(6 * i) - start.state.v.segment<6>(6 * i)));
    gained += turned(state, solution.v) - turned(start.state, start.state.v);
  }
  if (step.past_impulse.size() > 0) gained -= step.past_impulse.dot(relative_velocity(step.problem, mean));
  work->scheme -= gained;
}

}  // namespace

StepWork& StepWork::operator+=(const StepWork& other) {
  loads += other.loads;
  supports += other.supports;
  dilatancy += other.dilatancy;
  friction += other.friction;
  damping += other.damping;
  impact += other.impact;
  scheme += other.scheme;
  return *this;
}

StepStart begin_account(const Model& model, const State& state, const StepProblem& step,
                        const ContactMemories& memories, const StepOptions& options) {
  StepStart start{state, spring_energies(step, memories, options), {}, tie_energy(model, state, memories)};
  for (size_t i = 0; i < memories.ids.size(); ++i) start.elastic_gap.push_back(memories.of(i).elastic_gap);
  return start;
}

StepWork work_of_step(const Model& model, const StepStart& start, const StepProblem& step,
                      const ContactSolution& solution, const State& state, const ContactMemories& memories,
                      const StepOptions& options) {
  CUPOLA_ASSERT(static_cast<int>(start.springs.size()) == step.num_contacts);
  StepWork work;
  add_joint_work(model, start, step, solution, state, memories, options, &work);
  add_motion_work(model, start, step, solution, state, options, &work);
  return work;
}

JointWork joint_work(const StepProblem& step, int i, const Vec3& gamma, const Vec3& displacement) {
  const Vec3 force = gamma / step.impulse_time[i];
  const double normal = force[0] * displacement[0];
  JointWork work{.slip = -force.tail<2>().dot(displacement.tail<2>()), .dilatancy = std::max(0.0, normal)};
  if (!step.problem.strength.empty()) work.breaking = std::max(0.0, -normal);
  return work;
}

double yield_work(const StepProblem& step, int row, const ContactSolution& solution) {
  return solution.gamma[3 * row] / step.impulse_time[row] * plastic_elongation(step, row, solution);
}

}  // namespace cupola
