#include "solver/analysis/statics/static_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/statics/cyclic_reduction.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/kinematic_bound.hpp"

namespace cupola {
namespace {

constexpr int kMaxSolves = 40, kMaxSolvesOfPath = 250;
/// Newton iterations within which a point of the path converges, or h is too large.
constexpr int kIterationsOfPath = 15;
constexpr double kSolveShare = 0.1;  // part of the tolerance for the contact solve; inertia takes the rest

/// Lower bound of the sum of normal forces of any equilibrium, over the sum found or the sum of the loads if
/// that is larger, from which a motion counts as proven.
constexpr double kProven = 100.0;

/// A speed ratio smaller than that of any mechanism whose load exceeds the critical one by a millionth.
constexpr double kAtRest = 1e-6;

/// Mean block weight over the largest load on a block. The equilibrium residual is relative to the former,
/// the residual of a contact solve to the latter, which is far larger where small blocks carry large loads.
double weight_over_load(const Model& model, double acceleration) {
  return model.block_weight > 0.0 ? model.loads.gravity.norm() / acceleration : 1.0;
}

/// Solves the whole problem, or one sector of it if the model has cyclic symmetry.
SolveSummary solve_problem(const ContactProblem& problem, const CyclicSymmetry* symmetry,
                           const ContactSolverOptions& options, ContactSolver* solver,
                           ContactSolution* solution) {
  if (!symmetry) return solver->solve(problem, options, solution);
  ContactSolution sector = restrict(*solution, *symmetry);
  SolveSummary summary = solver->solve(reduce(problem, *symmetry), options, &sector);
  *solution = expand(sector, problem, *symmetry);
  return summary;
}

/// The proximal-point iteration of one scene.
class ProximalPoint {
 public:
  ProximalPoint(const Model& model, const State& start, const ContactSet& contacts,
                const ContactMemories& memories, const StaticOptions& options)
      : model_(model),
        start_(start),
        contacts_(contacts),
        memories_(memories),
        options_(options),
        associated_(options.solve.law.is_associated()),
        acceleration_(reference_acceleration(model, start)),
        largest_h_(largest_static_step(model, start, contacts)) {
    follows_path_ =
        !associated_ && options.solve.method == ContactMethod::newton && std::isfinite(largest_h_);
    set_step(first_static_step(model, start, contacts, acceleration_, options));
  }

  /// Starts from the displacements and forces of another solve of the same scene instead of following a path.
  void start_from(const StaticSolution& other) {
    follows_path_ = false;
    set_step(other.h);
    x_ = other.step_solution;
  }
  StaticSolution run();

 private:
  void set_step(double h);
  double solve_tolerance() const;
  void iterate();
  bool accepts(const StaticSolution& trial) const;
  bool is_accurate_enough(const StaticSolution& trial) const;
  bool shorten_step();
  void speed_up(double contraction);
  double proof(const StaticSolution& trial) const;
  bool moves_steadily(double contraction, int count);
  bool moves_far();
  StaticSolution finish(StaticOutcome outcome, std::string message);

  const Model& model_;
  const State& start_;
  const ContactSet& contacts_;
  const ContactMemories& memories_;
  const StaticOptions& options_;
  const bool associated_;
  bool follows_path_ = false;  // solve_static(): non-associated law, compliant joints, Newton's method
  const double acceleration_;  // m/s2, reference
  const double largest_h_;     // s
  ContactSolver solver_;
  StepProblem step_;             // at trial_.h; its v_star is the free velocity at rest, h M^-1 w
  ContactSolution x_;            // last accepted iterate, at trial_.h
  StaticSolution trial_, best_;  // without the contact problem, which is large
  double residual_ = 1.0;        // equilibrium residual of x_; at the start, of the unsupported structure
  double tightening_ = 1.0;      // factor on the tolerance of the contact solves
  int num_shortened_ = 0, num_steady_ = 0;
  double settlement_ = 0.0;                                    // m, largest displacement of the first iterate
  double failed_h_ = std::numeric_limits<double>::infinity();  // s, step at which Newton failed last
  double lowest_residual_ = std::numeric_limits<double>::infinity();  // steps of a quarter
  double travel_ = 0.0;  // m, sum of the largest displacements since lowest_residual_
  VecX moved_;           // m, rad: displacement of the last iteration (6 nb)
  VecX flow_;            // m/s2: moved_ / h^2 while the path is far from equilibrium, else empty
};

/// Sets h and converts the last iterate: d = h v and F = gamma / h stay.
void ProximalPoint::set_step(double h) {
  if (x_.v.size() > 0) x_.v *= trial_.h / h;
  if (x_.gamma.size() > 0) x_.gamma *= h / trial_.h;
  trial_.h = h;
  step_ = build_step_problem(model_, start_, contacts_, memories_, static_step_options(options_, h));
}

/// Tolerance of the next contact solve: a small part of the last residual, as an inexact proximal-point
/// method requires, but no smaller than the answer requires.
double ProximalPoint::solve_tolerance() const {
  const double kCoarse = follows_path_ ? 0.1 : 1e-4;
  const double kShare = follows_path_ ? 0.03 : 1e-3;  // of the last residual
  constexpr double kRounding = 1e-12;                 // smallest tolerance that weight_over_load() may cause
  const double scale = weight_over_load(model_, acceleration_);
  const double own = kSolveShare * options_.tolerance;
  const double fine = std::max(own * scale, std::min(own, kRounding));
  return tightening_ * std::max(fine, std::min(kCoarse, kShare * residual_ * scale));
}

void ProximalPoint::iterate() {
  constexpr double kMomentum = 0.5;  // doubles the speed of a slow slide; 0.7 overshoots
  ContactSolverOptions solve = options_.solve;
  solve.reference_speed = trial_.h * acceleration_;
  solve.tolerance = solve_tolerance();
  // After the first iteration few joints change their state, and the last factor is a good preconditioner.
  solve.lag_factor = !follows_path_ && x_.v.size() > 0 && !has_many_blocks(step_.problem);
  if (follows_path_ && !solve.max_iterations) solve.max_iterations = kIterationsOfPath;
  ContactProblem& problem = step_.problem;
  const VecX rest = problem.v_star;
  const VecX before = x_.v.size() > 0 ? x_.v : VecX::Zero(rest.size());
  const bool slides = flow_.size() > 0;
  const VecX free = slides ? VecX(before + kMomentum * trial_.h * flow_) : before;  // without forces
  problem.v_star += free;
  trial_.step_solution = x_;
  if (slides) trial_.step_solution.v = free;
  trial_.solve = solve_problem(problem, options_.symmetry, solve, &solver_, &trial_.step_solution);
  trial_.iterations += trial_.solve.iterations;
  if (!trial_.solve.usable()) {
    trial_.step_solution.v = free;
    trial_.step_solution.gamma = x_.gamma.size() > 0 ? x_.gamma : VecX::Zero(problem.b.size());
  }
  trial_.residuals = compute_residuals(problem, trial_.step_solution, solve.reference_speed, solve.law);
  problem.v_star = rest;
  CUPOLA_ASSERT(trial_.step_solution.v.allFinite() && trial_.step_solution.gamma.allFinite());
  trial_.increment = trial_.h * (trial_.step_solution.v - free);
  moved_ = trial_.h * (trial_.step_solution.v - before);
  trial_.speed_ratio = largest_speed(trial_.increment) / (trial_.h * solve.reference_speed);
  trial_.forces = joint_forces(contacts_, trial_.step_solution.gamma, step_.impulse_time);
  trial_.balance =
      compute_equilibrium(model_, start_, contacts_, trial_.forces, start_.time + options_.time_advance);
}

/// Judged by residuals that are computed independently of the contact method.
bool ProximalPoint::accepts(const StaticSolution& trial) const {
  return trial.solve.usable() && trial.balance.residual <= options_.tolerance &&
         excess(trial.residuals, options_.tolerance) <= 1.0;
}

/// True if the error of the contact solve is small compared with the imbalance that remains, so that the next
/// iteration may start from it.
bool ProximalPoint::is_accurate_enough(const StaticSolution& trial) const {
  constexpr double kShare = 1e-2;
  if (!trial.solve.usable()) return false;
  if (trial.solve.ending == SolveEnding::converged) return true;
  return std::max(trial.residuals.momentum, trial.residuals.contact_law) <= kShare * trial.speed_ratio;
}

/// A shorter step makes the contact problem easier, because inertia carries a larger share. False if this was
/// tried often enough or the user limits the iterations.
bool ProximalPoint::shorten_step() {
  constexpr int kMaxShortened = 4, kMaxShortenedOfPath = 60;
  constexpr double kFactor = 0.1, kPathFactor = 0.4;
  constexpr double kSettling = 0.0126;  // g h^2 is then of the size of the settlement (first_static_step())
  if (options_.solve.max_iterations ||
      ++num_shortened_ > (follows_path_ ? kMaxShortenedOfPath : kMaxShortened))
    return false;
  failed_h_ = trial_.h;
  set_step(trial_.h * (!follows_path_ ? kFactor : num_shortened_ == 1 ? kSettling : kPathFactor));
  return true;
}

/// After an iteration that reduced the residual by less than a digit: lengthens the step, because an elastic
/// mode of eigenvalue lambda contracts by 1 / (1 + h^2 lambda). Rigid joints do not contract; what remains at
/// rest is the error of the contact solve, summed over the courses.
void ProximalPoint::speed_up(double contraction) {
  constexpr double kBelowFailed = 0.7, kForgetting = 1.2, kNear = 1e-4;
  constexpr double kSlow = 0.1, kWanted = 1e-2, kSmallest = 2.0, kLargest = 10.0, kTightening = 0.1;
  if (contraction <= kSlow) return;
  if (trial_.speed_ratio <= kAtRest && std::isinf(largest_h_)) tightening_ *= kTightening;
  if (std::isinf(largest_h_)) return;
  if (follows_path_) {
    const int n = trial_.solve.iterations;
    const double factor = n <= 3 ? 2.5 : n <= 6 ? 1.6 : n <= 9 ? 1.0 : 0.7;
    // Just below a step that failed the next one fails too, until the structure has moved on.
    const double limit = std::min(largest_h_, std::max(kBelowFailed * failed_h_, trial_.h));
    failed_h_ *=
        residual_ < kNear ? factor : kForgetting;  // near equilibrium few contacts change their state
    const double h = std::min(limit, factor * trial_.h);
    if (h != trial_.h) set_step(h);
    return;
  }
  const double growth = contraction < 1.0 ? std::sqrt(contraction / (1.0 - contraction) / kWanted) : kLargest;
  const double h = std::min(largest_h_, std::clamp(growth, kSmallest, kLargest) * trial_.h);
  if (h > trial_.h) set_step(h);
}

/// Lower bound of the sum of the normal forces of any equilibrium, from the motion, over the larger of the
/// sum found and the sum of the loads.
double ProximalPoint::proof(const StaticSolution& trial) const {
  double loads = 0.0;
  const VecX f = applied_forces(model_, start_, start_.time + options_.time_advance);
  for (Eigen::Index i = 0; i < f.size(); i += 6) loads += f.segment<3>(i).norm();
  return required_normal_force(step_.problem, trial.increment / trial.h) /
         std::max(loads, normal_force_sum(step_.problem, trial.step_solution.gamma));
}

/// True if `count` iterations in a row left the residual as it was and the blocks move.
bool ProximalPoint::moves_steadily(double contraction, int count) {
  constexpr double kSteady = 0.05;
  const bool steady = std::abs(contraction - 1.0) < kSteady && trial_.speed_ratio > kAtRest;
  num_steady_ = steady ? num_steady_ + 1 : 0;
  return num_steady_ >= count;
}

/// True if blocks have moved by 100 times the settlement since the residual last fell by a quarter below its lowest
/// value. During a collapse it fluctuates above that value.
bool ProximalPoint::moves_far() {
  constexpr double kFall = 0.75, kFar = 100.0;
  // Heads softer than the bed engage after a slip that is long compared with the settlement on the bed.
  constexpr double kShareOfBlock = 0.05;
  if (residual_ < kFall * lowest_residual_) {
    lowest_residual_ = residual_;
    travel_ = 0.0;
    return false;
  }
  travel_ += largest_speed(moved_);
  const double far = options_.follow_from_start
                         ? std::max(kFar * settlement_, kShareOfBlock * smallest_block_size(*model_.assembly))
                         : kFar * settlement_;
  return trial_.speed_ratio > kAtRest && travel_ > far;
}

StaticSolution ProximalPoint::finish(StaticOutcome outcome, std::string message) {
  StaticSolution answer = std::move(outcome == StaticOutcome::unconverged && best_.h > 0.0 ? best_ : trial_);
  answer.iterations = trial_.iterations;
  answer.outcome = outcome;
  answer.message = std::move(message);
  x_ = {};
  if (answer.h != trial_.h) set_step(answer.h);
  answer.step = std::move(step_);
  if (answer.increment.size() > 0)
    answer.step.problem.v_star += answer.step_solution.v - answer.increment / answer.h;
  return answer;
}

StaticSolution ProximalPoint::run() {
  constexpr int kMoving = 3, kUnproven = 15;  // steady iterations until the search ends
  constexpr double kFarFromBalance = 1e-6;    // residual above which the path keeps its momentum
  constexpr double kSlow = 0.7;               // contraction from which blocks slide slowly over a long way
  const bool associated = associated_;
  const int max_solves = follows_path_ ? kMaxSolvesOfPath : kMaxSolves;
  for (int k = 0; k < max_solves; ++k) {
    iterate();
    options_.log(fmt::format(
        "static  h {:9.3e} s  iterations {:3d}  momentum {:9.2e}  law {:9.2e}  equilibrium {:9.2e}  "
        "increment/(g h^2) {:9.2e}",
        trial_.h, trial_.solve.iterations, trial_.residuals.momentum, trial_.residuals.contact_law,
        trial_.balance.residual, trial_.speed_ratio));
    if (!is_accurate_enough(trial_)) {
      if (trial_.solve.usable() && best_.h == 0.0) best_ = trial_;
      if (accepts(trial_)) break;
      if (shorten_step()) continue;
      return finish(StaticOutcome::unconverged,
                    fmt::format("the contact problem was not solved: {}", trial_.solve.message));
    }
    if (accepts(trial_)) break;
    if (settlement_ == 0.0) settlement_ = trial_.h * largest_speed(trial_.step_solution.v);
    const double contraction = trial_.balance.residual / residual_;
    residual_ = trial_.balance.residual;
    x_ = trial_.step_solution;
    const bool slides = follows_path_ && contraction > kSlow && residual_ > kFarFromBalance;
    flow_ = slides ? VecX(moved_ / (trial_.h * trial_.h)) : VecX();
    if (best_.h == 0.0 || residual_ < best_.balance.residual) best_ = trial_;
    if (contraction > 0.5 && trial_.speed_ratio > kAtRest) {
      const double needed = proof(trial_);
      if (associated && needed >= kProven)
        return finish(
            StaticOutcome::moving,
            fmt::format(
                "no equilibrium exists: blocks accelerate at up to {:.3g} m/s2, and an equilibrium would "
                "need normal forces {:.2g} times the larger of those found and the loads",
                trial_.speed_ratio * acceleration_, needed));
      const bool steady =
          !follows_path_ ? moves_steadily(contraction, associated ? kUnproven : kMoving) : moves_far();
      if (associated && steady)
        return finish(
            StaticOutcome::unconverged,
            fmt::format(
                "blocks accelerate at up to {:.3g} m/s2 in {}, but it is not proven that no "
                "equilibrium exists: it would need normal forces {:.2g} times the larger of those found "
                "and the loads, and the proof requires {:g} times",
                trial_.speed_ratio * acceleration_, counted(kUnproven, "iteration"), needed, kProven));
      if (!associated && steady)
        return finish(
            StaticOutcome::moving,
            fmt::format("a steady motion was found: blocks accelerate at up to {:.3g} m/s2{}; not proven: "
                        "other contact forces might balance the loads",
                        trial_.speed_ratio * acceleration_,
                        follows_path_ ? fmt::format(" and have moved by {:.3g} m, {:.0f} times their first "
                                                    "settlement",
                                                    travel_, travel_ / settlement_)
                                      : ""));
    }
    speed_up(contraction);
  }
  if (accepts(trial_)) {
    std::string message = fmt::format("equilibrium residual {:.2e} <= tolerance {:.2e}",
                                      trial_.balance.residual, options_.tolerance);
    if (trial_.residuals.contact_law > options_.tolerance)  // accepted as rounding: say so
      message += "; " + residuals_text(trial_.residuals, options_.tolerance);
    return finish(StaticOutcome::equilibrium, message);
  }
  return finish(StaticOutcome::unconverged,
                fmt::format("equilibrium residual {:.2e} > tolerance {:.2e} after {}", best_.balance.residual,
                            options_.tolerance, counted(max_solves, "solve")));
}

void certify(const Model& model, const State& start, const ContactSet& contacts, const StaticOptions& options,
             StaticSolution* solution) {
  if (solution->outcome != StaticOutcome::equilibrium) {
    solution->certificate.force_error.bounds = "the static problem was not solved";
    return;
  }
  const VecX loads = applied_forces(model, start, start.time + options.time_advance);
  solution->certificate = certify_static(contacts, loads, solution->step.problem, solution->step_solution,
                                         options.solve.law, model.loads.gravity.norm(), options.symmetry);
  if (solution->certificate.balance == Balance::unstable)
    solution->message +=
        "; unstable balance: joints and weight give a negative stiffness, so that a small disturbance would "
        "end the equilibrium";
}

/// True if the path showed nothing: it ended without a verdict, or called a motion steady before any block had
/// moved by 1 % of the smallest. Stiff joints beside soft ones, or nearly rigid ones, do that.
bool shows_nothing(const Model& model, const StaticSolution& solution) {
  constexpr double kShare = 0.01;
  if (solution.outcome != StaticOutcome::moving) return solution.outcome == StaticOutcome::unconverged;
  return largest_speed(solution.step_solution.v) * solution.h < kShare * smallest_block_size(*model.assembly);
}

/// True if no compliant contact slips in the solution under the associated law, which then obeys every flow
/// rule. Rigid contacts are left out, because their forces are not unique.
bool slips_nowhere(const StaticSolution& solution, const FlowRule& law, double acceleration) {
  const StepProblem& step = solution.step;
  for (int i = 0; i < step.problem.num_contacts(); ++i)
    if (is_rigid(contact_law(step.problem, i))) return false;
  return compute_residuals(step.problem, solution.step_solution, solution.h * acceleration, law)
             .contact_law <= kOutcomeTolerance;
}

}  // namespace

StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options) {
  StaticSolution solution;
  if (options.solve.law.is_associated()) {
    solution = ProximalPoint(model, start, contacts, memories, options).run();
  } else {
    StaticOptions associated = options;
    associated.solve.law = FrictionLaw::associated;
    associated.tolerance = std::max(options.tolerance, kOutcomeTolerance);
    StaticSolution first = ProximalPoint(model, start, contacts, memories, associated).run();
    if (first.outcome == StaticOutcome::moving) {
      first.message += ", under either friction law";
      return first;
    }
    int iterations = first.iterations;
    const bool stands = first.outcome == StaticOutcome::equilibrium;
    const auto from_associated = [&] {
      ProximalPoint again(model, start, contacts, memories, options);
      again.start_from(first);
      return again.run();
    };
    if (stands && slips_nowhere(first, options.solve.law, reference_acceleration(model, start)))
      solution = from_associated();
    if (solution.outcome != StaticOutcome::equilibrium) {
      iterations += solution.iterations;
      solution = ProximalPoint(model, start, contacts, memories, options).run();
      if (stands && !options.follow_from_start && shows_nothing(model, solution)) {
        if (StaticSolution second = from_associated(); second.outcome == StaticOutcome::equilibrium)
          solution = std::move(second);
      }
    }
    first = {};
    solution.iterations += iterations;
  }
  certify(model, start, contacts, options, &solution);
  return solution;
}

StepProblem first_static_problem(const Model& model, const State& start, const ContactSet& contacts,
                                 const ContactMemories& memories, const StaticOptions& options) {
  const double h = first_static_step(model, start, contacts, reference_acceleration(model, start), options);
  return build_step_problem(model, start, contacts, memories, static_step_options(options, h));
}

LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options) {
  LoadedState loaded{start, memories, solution.h};
  loaded.state.v = solution.step_solution.v;
  integrate_positions(model, solution.h, options.time_advance, loaded.state.v, &loaded.state);
  loaded.state.v.setZero();  // v was only the displacement over h
  update_memories(model, solution.step, solution.step_solution, start, contacts,
                  static_step_options(options, solution.h), &loaded.memories);
  return loaded;
}

}  // namespace cupola
