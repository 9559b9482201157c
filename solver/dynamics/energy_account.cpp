#include "solver/dynamics/energy_account.hpp"

#include <algorithm>

#include "assembly/base/error.hpp"
#include "solver/dynamics/energy.hpp"

namespace cupola {
namespace {

/// h u_el has the compliance c = E h (h + alpha) of the step problem.
double spring_energy(const Vec3& E, const ContactMemory& memory, double h_h_alpha) {
  double energy = 0.0;
  if (E[0] > 0.0) energy += 0.5 * memory.elastic_gap * memory.elastic_gap / (E[0] * h_h_alpha);
  if (E[1] > 0.0) energy += 0.5 * memory.elastic_slip_A.squaredNorm() / (E[1] * h_h_alpha);
  return energy;
}

std::vector<double> spring_energies(const StepProblem& step, const ContactMemories& memories,
                                    const StepOptions& options) {
  std::vector<double> energies(memories.values.size());
  const double h_h_alpha = options.h * (options.h + options.damping);
  for (size_t i = 0; i < energies.size(); ++i)
    energies[i] = spring_energy(step.problem.E.segment<3>(3 * static_cast<Eigen::Index>(i)),
                                memories.values[i], h_h_alpha);
  return energies;
}

/// J, of the viscous part of compliant rows: their compliance is c = E h (h + alpha).
double damping_work(const Vec3& E, const Vec3& u_el, const StepOptions& options) {
  double work = 0.0;
  for (int k = 0; k < 3; ++k)
    if (E[k] > 0.0) work += options.damping * u_el[k] * u_el[k] / (E[k] * (options.h + options.damping));
  return work;
}

/// Work of the contacts and ties: what the joints dissipate, and the springs beyond what they store.
void add_joint_work(const Model& model, const StepStart& start, const StepProblem& step,
                    const ContactSolution& solution, const State& state, const ContactMemories& memories,
                    const StepOptions& options, StepWork* work) {
  const ContactProblem& problem = step.problem;
  const VecX u = relative_velocity(problem, solution.v), u_start = relative_velocity(problem, start.state.v);
  const VecX b = problem.b - step.support_velocity;
  const VecX u_el = -(b + problem.E.cwiseProduct(solution.gamma));
  const std::vector<double> springs = spring_energies(step, memories, options);
  work->supports = -solution.gamma.dot(step.support_velocity);
  work->friction = joint_dissipation(step, solution);
  for (int i = 0; i < step.num_contacts; ++i) {
    const Vec3 gamma = solution.gamma.segment<3>(3 * i), E = problem.E.segment<3>(3 * i);
    const Vec3 elastic = u_el.segment<3>(3 * i), support = step.support_velocity.segment<3>(3 * i);
    const double opening = u[3 * i] + support[0] - elastic[0];
    work->dilatancy += std::max(0.0, gamma[0] * opening);
    const double damping = gamma.isZero(0.0) ? 0.0 : damping_work(E, elastic, options);
    work->damping += damping;
    double lost = -gamma.dot(elastic) - (springs[i] - start.springs[i]) - damping;
    const double approach_per_step = options.h * (u_start[3 * i] + support[0]);
    if (gamma[0] > 0.0 && approach_per_step < start.elastic_gap[i]) {
      const double approach = 0.5 * gamma.dot(u.segment<3>(3 * i) - u_start.segment<3>(3 * i));
      work->impact += lost + approach;
      work->scheme -= approach;
    } else {
      work->scheme += lost;
    }
  }
  for (int row = step.num_contacts; row < problem.num_contacts(); ++row) {
    const double gamma = solution.gamma[3 * row], u_tie = u[3 * row] + step.support_velocity[3 * row];
    const double damping =
        gamma == 0.0 ? 0.0 : damping_work({problem.E[3 * row], 0.0, 0.0}, {u_tie, 0.0, 0.0}, options);
    work->damping += damping;
    work->scheme -= gamma * u_tie + damping;
  }
  work->scheme -= tie_energy(model, state.poses) - tie_energy(model, start.state.poses);
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
  // With loads that do the work of the step's forces, and inertia that does not turn, this is zero.
  double turning = potential(state, middle) - potential(start.state, middle);
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Mat6& M = step.problem.M[i];
    const auto before = start.state.v.segment<6>(6 * i), after = solution.v.segment<6>(6 * i);
    work->scheme += 0.5 * (after - before).dot(M * (after - before));
    turning += after.dot(M * (step.problem.v_star.segment<6>(6 * i) - before));
    const Mat6 turned = mass_matrix(model.assembly->blocks[block], state.poses[block].q_WB);
    turning += 0.5 * after.dot((turned - M) * after);
  }
  work->scheme -= turning;
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

StepStart begin_account(const State& state, const StepProblem& step, const ContactMemories& memories,
                        const StepOptions& options) {
  StepStart start{state, spring_energies(step, memories, options), {}};
  for (const ContactMemory& memory : memories.values) start.elastic_gap.push_back(memory.elastic_gap);
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
