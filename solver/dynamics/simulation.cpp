#include "solver/dynamics/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/collision/fast_blocks.hpp"
#include "solver/dynamics/elastic_impact.hpp"
#include "solver/dynamics/joint_damage.hpp"
#include "solver/dynamics/law_violation.hpp"

namespace cupola {
namespace {

/// Estimated error of the position in one step, m, of the block where it is largest: h |v+ - v| / 2 of
/// implicit Euler; of the generalized alpha method h^2 |beta - 1/6| |(v+ - v) / h - a|, O. C. Zienkiewicz and
/// Y. M. Xie (1991), Earthq. Eng. Struct. Dyn. 20, 871.
double step_error(const StepProblem& step, const VecX& before, const VecX& after, double h) {
  constexpr double kBeta = 4.0 / 9.0;
  if (step.acceleration.size() == 0) return 0.5 * h * largest_speed(after - before);
  return h * (kBeta - 1.0 / 6.0) * largest_speed(after - before - h * step.acceleration);
}

/// Next step size, s. The error is proportional to h^2 in smooth motion, or h^3 of the generalized alpha
/// method. The change per step is limited, so that a single impact does not make the step size oscillate.
double next_step(const AdaptiveStep& adaptive, const Integrator& integrator, double h, double error) {
  const double ratio = adaptive.displacement_error / error;
  const double proposed = !(error > 0.0)
                              ? adaptive.largest
                              : 0.9 * h * (integrator.is_euler() ? std::sqrt(ratio) : std::cbrt(ratio));
  return std::clamp(std::clamp(proposed, 0.2 * h, 2.0 * h), adaptive.smallest, adaptive.largest);
}

/// s: h, or a shorter step in which contacts of fast blocks are found. The time error of a free fall may be
/// 0, so that it does not bound the step.
double detected_step(const Model& model, const CollisionModel& shapes, const State& state, double h,
                     double middle) {
  State end = state;
  const VecX f = applied_forces(model, state, state.time + 0.5 * h);
  VecX v = state.v;
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Mat6 M = mass_matrix(model.bodies[block], state.poses[block].q_WB);
    v.segment<6>(6 * i) += h * M.llt().solve(f.segment<6>(6 * i));
  }
  integrate_positions(model, h, h, v, &end);
  const std::optional<FastPair> fast = fast_pair(shapes, state.poses, end.poses, h, middle);
  return fast ? fast->longest : h;
}

/// m/s, by which the mean velocity of the ground over the last step would differ had that step been as long as
/// the next. From one step to another of its length it changes by a h, of which its acceleration a follows; to
/// one of another length by a (last + next) / 2, which would jolt what stands on the ground.
Vec3 ground_correction(const GroundMotion& ground, const State& state, double last, double next) {
  if (last == 0.0 || last == next || ground.direction.isZero(0.0)) return Vec3::Zero();
  const Vec3 before = (state.ground - ground.displacement(state.time - last)) / last;
  const Vec3 after = (ground.displacement(state.time + next) - state.ground) / next;
  return (last - next) / (last + next) * (after - before);
}

/// J, of the blocks of a problem at the velocities v.
double kinetic_energy(const ContactProblem& problem, const VecX& v) {
  double energy = 0.0;
  for (int i = 0; i < problem.num_blocks(); ++i)
    energy += 0.5 * v.segment<6>(6 * i).dot(problem.M[i] * v.segment<6>(6 * i));
  return energy;
}

[[maybe_unused]] bool is_finite(const State& state) {
  const auto finite = [](const Pose& pose) {
    return pose.p_WB.allFinite() && pose.q_WB.coeffs().allFinite();
  };
  return state.v.allFinite() && std::all_of(state.poses.begin(), state.poses.end(), finite);
}

}  // namespace

Simulation::Simulation(Model model, const SimulationOptions& options)
    : model_(std::move(model)),
      options_(options),
      state_(state_at_rest(model_)),
      detector_(*model_.assembly, options.detection),
      next_h_(options.step.h) {
  move_supports(model_, &state_);
  memories_.ties.resize(model_.ties.size());
  energy_ = energy();
  for (const int block : model_.free_blocks) radius_.push_back(detector_.block_radius(block));
}

StepReport Simulation::advance(double h_max) {
  StepOptions step = options_.step;
  step.h = std::min(next_h_, h_max);
  if (options_.adaptive)
    step.h = std::min(
        step.h, std::max(options_.adaptive->smallest,
                         detected_step(model_, detector_.model(), state_, step.h, step.integrator.middle)));
  const State middle = middle_of_step(model_, state_, step);
  detector_.update(middle.poses, travel(step.h));
  heat_contacts(middle.poses);
  const ContactSet& contacts = this->contacts();
  bool changed = detections_followed_ != detector_.num_detections();
  if (changed) follow_detection(contacts, middle.poses);
  if (options_.sleep && update_sleep(*options_.sleep, islands_, radius_, &state_, &sleep_state_)) {
    reduced_.reset();
    changed = true;
  }
  const double lost = changed && energy_ ? energy_->total() - energy().total() : 0.0;
  StepReport report = advance_detected(contacts, step);
  report.work.scheme += lost;
  return report;
}

void Simulation::heat_contacts(const std::vector<Pose>& poses) {
  if (!model_.heat.empty()) heated_ = model_.heat.heated(detector_.contacts(), poses, state_.time);
}

StepReport Simulation::advance_detected(const ContactSet& contacts, const StepOptions& step) {
  StepReport report = sleep_state_.num_asleep() > 0
                          ? advance_awake(contacts, step)
                          : solve_and_move(model_, contacts, step, &state_, &memories_);
  energy_ = report.energy = energy();
  return report;
}

void Simulation::follow_detection(const ContactSet& contacts, const std::vector<Pose>& contact_poses) {
  detections_followed_ = detector_.num_detections();
  memories_ = match_memories(std::move(memories_), contacts.points, contact_poses);
  if (options_.sleep) islands_ = islands_of(model_, contacts);
  reduced_.reset();
}

StepReport Simulation::advance_awake(const ContactSet& contacts, const StepOptions& step) {
  if (!reduced_) reduced_ = reduce_to_awake(model_, state_, contacts, memories_, sleep_state_, step.h);
  ScenePart& part = reduced_->awake;
  for (size_t k = 0; k < part.contact_rows.size(); ++k)
    part.contacts.points[k] = contacts.points[part.contact_rows[k]];
  StepReport report = solve_and_move(part.model, part.contacts, step, &part.state, &part.memories);
  report.num_asleep = sleep_state_.num_asleep();

  // Transfer the results to the whole scene.
  std::vector<double> violations(contacts.points.size(), std::numeric_limits<double>::quiet_NaN());
  for (size_t k = 0; k < part.contact_rows.size(); ++k) {
    violations[part.contact_rows[k]] = report.violations[k];
    reduced_->forces.contacts[part.contact_rows[k]] = report.forces.contacts[k];
    memories_.stored()[part.contact_rows[k]] = part.memories.of(k);
  }
  report.forces = reduced_->forces;
  report.violations = std::move(violations);
  report.balance = combine(report.balance, reduced_->balance);
  state_.time = part.state.time;
  for (int k = 0; k < part.model.num_free(); ++k) {
    const int block = part.model.free_blocks[k];
    state_.poses[block] = part.state.poses[block];
    state_.v.segment<6>(6 * model_.free_index[block]) = part.state.v.segment<6>(6 * k);
  }
  return report;
}

StepProblem Simulation::solve_step(const Model& model, const ContactSet& contacts, const State& middle,
                                   const StepOptions& step, const State& state, ContactMemories* memories,
                                   ContactSolution* solution, StepReport* report) {
  constexpr int kMostPasses = 50;
  StepProblem problem;
  ContactSolverOptions solve_options = options_.solve;
  solve_options.reference_speed = step.h * reference_acceleration(model, state);
  if (model.joints.has_strength()) begin_step(contacts, memories);
  for (int pass = 0; pass < kMostPasses; ++pass) {
    problem = build_step_problem(model, middle, contacts, *memories, step);
    if (pass == 0) *solution = warm_start(problem, middle, contacts, *memories);
    const SolveSummary solved = solver_.solve(problem.problem, solve_options, solution);
    report->solve = pass == 0 ? solved : solved.after(report->solve);
    if (!model.joints.has_strength() || !report->solve.usable() ||
        !refine_step(model, state, contacts, problem, *solution, step, memories))
      break;
  }
  report->residuals =
      compute_residuals(problem.problem, *solution, solve_options.reference_speed, solve_options.law);
  return problem;
}

StepReport Simulation::solve_and_move(const Model& model, const ContactSet& contacts, StepOptions step,
                                      State* state, ContactMemories* memories) {
  constexpr double kTolerated = 4.0;  // ratio to the allowed error above which the step is repeated
  StepReport report;
  StepProblem problem;
  ContactSolution solution;
  State middle;
  const VecX v = state->v;
  while (true) {
    // 1. Build and solve the contact problem
    const Vec3 correction = ground_correction(model.ground, *state, last_h_, step.h);
    state->v = v;
    if (!correction.isZero(0.0))
      for (int i = 0; i < model.num_free(); ++i) state->v.segment<3>(6 * i) += correction;
    middle = middle_of_step(model, *state, step);
    problem = solve_step(model, contacts, middle, step, *state, memories, &solution, &report);
    report.time_error = step_error(problem, state->v, solution.v, step.h);
    if (!options_.adaptive) break;

    // 2. Control the step size
    next_h_ = next_step(*options_.adaptive, step.integrator, step.h, report.time_error);
    if (report.time_error <= kTolerated * options_.adaptive->displacement_error || next_h_ >= step.h) break;
    step.h = next_h_;
    // The contacts are those of the middle of the step, which moves.
    if (!step.integrator.is_euler()) {
      const State again = middle_of_step(model, *state, step);
      detector_.update(again.poses, travel(step.h));
      heat_contacts(again.poses);
      if (detections_followed_ != detector_.num_detections()) follow_detection(contacts, again.poses);
    }
  }
  report.h = last_h_ = step.h;
  report.forces = joint_forces(contacts, solution.gamma, problem.impulse_time);
  report.violations = law_violations(contacts, solution.gamma,
                                     contact_law_errors(problem.problem, solution, options_.solve.law));
  report.balance =
      compute_equilibrium(model, middle, contacts, report.forces, state->time + 0.5 * step.advance());

  // 3. Update memories and integrate
  const StepStart start = begin_account(model, *state, problem, *memories, step);
  update_memories(model, problem, solution, middle, contacts, step, memories);
  integrate_positions(model, step.h, step.advance(), mean_velocity(problem, *state, solution, step), state);
  state->v = solution.v;
  report.work = work_of_step(model, start, problem, solution, *state, *memories, step);
  report.work.scheme -= kinetic_energy(problem.problem, start.state.v) - kinetic_energy(problem.problem, v);
  report.elastic_impact =
      elastic_impact(start, problem, solution, reference_acceleration(model, start.state), step);
  report.problem = std::move(problem);
  report.step_solution = std::move(solution);
  CUPOLA_ASSERT(!report.solve.usable() || is_finite(*state));
  return report;
}

void Simulation::start_from(const LoadedState& loaded) {
  CUPOLA_ASSERT(loaded.h > 0.0 && loaded.state.poses.size() == state_.poses.size());
  // Contacts must get the identities that they had in the static solve.
  contacts_at_rest(model_, &detector_);
  state_ = loaded.state;
  const ContactSet& contacts = detector_.update(state_.poses);
  memories_ = match_memories(loaded.memories, contacts.points, state_.poses);
  // In the single static step, sliding under the associated law opens a loaded joint by mu times its slip.
  // That opening becomes the zero of its gap.
  std::vector<double> gaps;
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const bool carries_load = memories_.of(i).impulse[0] > 0.0;
    gaps.push_back(carries_load ? memories_.of(i).elastic_gap : contacts.points[i].gap);
  }
  detector_.set_gaps(gaps);
  heat_contacts(state_.poses);
  // The same forces act during the first step.
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    ContactMemory& memory = memories_.stored()[i];
    const Contact& contact = contacts.points[i];
    const Vec3 impulse = in_present_frame(memory, contact, state_);
    continue_from_rest(contact_frame(contact.normal) * (impulse / loaded.h), state_.poses[contact.block_a],
                       &memory);
    memory.impulse = memory.impulse / loaded.h * next_h_;
  }
  for (TieMemory& tie : memories_.ties) tie.impulse = tie.impulse / loaded.h * next_h_;
  energy_ = energy();
}

std::vector<double> Simulation::travel(double h) const {
  std::vector<double> distance(state_.poses.size(), 0.0);
  const VecX f = applied_forces(model_, state_, state_.time + 0.5 * h);
  // Blocks that approach each other undetected are half the margin apart.
  const double allowed = 0.25 * detector_.margin();
  for (int i = 0; i < model_.num_free(); ++i) {
    const int block = model_.free_blocks[i];
    const auto reached = [&](const Vec6& v) {
      return h * (v.head<3>().norm() + radius_[i] * v.tail<3>().norm());
    };
    const Mat6 M = mass_matrix(model_.bodies[block], state_.poses[block].q_WB);
    const Vec6 gained = h * M.llt().solve(f.segment<6>(6 * i));
    distance[block] = reached(state_.v.segment<6>(6 * i)) + std::max(0.0, reached(gained) - allowed);
  }
  std::vector<Pose> moved = state_.poses;
  place_supports(*model_.assembly, model_.support_motions, state_.time + h, &moved);
  for (const SupportMotion& motion : model_.support_motions)
    distance[motion.block] =
        motion_bound(state_.poses[motion.block], moved[motion.block], detector_.block_radius(motion.block));
  return distance;
}

Vec3 Simulation::linear_momentum() const {
  Vec3 momentum = Vec3::Zero();
  for (int i = 0; i < model_.num_free(); ++i) {
    const int block = model_.free_blocks[i];
    const Mat6 M = mass_matrix(model_.bodies[block], state_.poses[block].q_WB);
    momentum += M.topRows<3>() * state_.v.segment<6>(6 * i);
  }
  return momentum;
}

}  // namespace cupola
