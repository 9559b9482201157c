#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/pace.hpp"
#include "assembly/base/process.hpp"
#include "assembly/case/case_times.hpp"
#include "assembly/files/byte_archive.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/motion/dynamic_history.hpp"
#include "solver/analysis/motion/motion_verdict.hpp"
#include "solver/analysis/record/joints_as_built.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/analysis/statics/static_start.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {

namespace {

constexpr int kStepsPerFactor = 10;  // a run can be interrupted at least this often

enum class Stop { no, time_over, collapsed, settled, solver_failed };

/// One dynamic analysis: the simulation, its progress and its output.
class DynamicRun {
 public:
  DynamicRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

  bool starts_static() const { return simulation_.options().static_start; }
  /// Starts from the static equilibrium under the loads at time 0. Returns false, and a summary, if there is
  /// none.
  bool start_static(Summary* summary);
  void resume(const std::string& bytes);
  /// Steps until a stop rule is met. Returns nothing if interrupted.
  std::optional<Summary> run();

 private:
  void step();
  void include_accuracy(double time);
  Stop stop_reason() const;
  bool frame_is_due(Stop stop) const;
  Frame last_frame() const;
  std::string checkpoint() const;
  Summary summarize(Stop stop, double seconds) const;

  const Case& scene_;
  const Analysis& analysis_;
  const AnalysisSinks& sinks_;
  Simulation simulation_;
  const JointsAsBuilt built_;
  const std::vector<KeyedTime> times_;  // of all loads, supports and frictions
  double last_change_ = 0.0;            // s
  RunProgress progress_;
  StepReport report_;
  State seen_;  // from the ground
  Snapshot now_;
  Pace saving_;  // between frames, since a stop that ends a solve saves nothing
};

DynamicRun::DynamicRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks)
    : scene_(scene),
      analysis_(scene.analysis),
      sinks_(sinks),
      simulation_(make_simulation(scene, assembly)),
      built_(simulation_.model(), simulation_.options().detection),
      times_(times_of(scene)) {
  for (const KeyedTime& time : times_) last_change_ = std::max(last_change_, last_change(time.function));
}

bool DynamicRun::start_static(Summary* summary) {
  const StaticStart start = start_from_equilibrium(scene_, sinks_.log, &simulation_);
  progress_.starts_unstable = start.solution.certificate.balance == Balance::unstable;
  if (start.solution.outcome == StaticOutcome::equilibrium) return true;
  const Model& model = simulation_.model();
  const Frame frame =
      static_frame(model, start.rest, start.contacts, start.memories, start.solution, start.options);
  sinks_.frame(frame);
  summarize_static(start.solution, frame, model, start.options.tolerance, summary);
  summary->message = "static start failed (analysis.start: static): " + summary->message;
  return false;
}

void DynamicRun::resume(const std::string& bytes) {
  std::string simulation;
  ByteReader archive(bytes);
  archive(progress_, simulation);
  simulation_.restore(simulation);
}

std::string DynamicRun::checkpoint() const {
  RunProgress progress = progress_;
  std::string simulation = simulation_.save();
  ByteWriter archive;
  archive(progress, simulation);
  return archive.bytes();
}

void DynamicRun::step() {
  if (progress_.steps == 0) progress_.energy.start = simulation_.energy().total();
  const std::vector<Pose> before = simulation_.state().poses;
  report_ = simulation_.advance(step_limit(scene_, times_, simulation_.state().time));
  CUPOLA_ASSERT(!report_.solve.usable() || simulation_.state().v.allFinite());
  seen_ = seen_from_ground(simulation_.model(), simulation_.state(), report_.h);
  now_ = take_snapshot(simulation_, seen_);
  ++progress_.steps;
  progress_.iterations += report_.solve.iterations;
  progress_.energy.include(report_);
  progress_.rest.include(simulation_.shapes(), simulation_.model(), seen_, now_.speed, analysis_.thresholds);
  const double time = simulation_.state().time;
  include_accuracy(time);
  if (const auto fast = fast_pair(simulation_.shapes(), before, simulation_.state().poses, report_.h,
                                  simulation_.options().step.integrator.middle);
      fast && progress_.fast_steps++ == 0) {
    progress_.fast = *fast;
    progress_.fast_time = time;
  }
  if (now_.displacement > progress_.farthest) {
    progress_.farthest = now_.displacement;
    progress_.farthest_time = time;
  }
  if (now_.speed > StopRules::kSettledSpeed) progress_.calm_since = time;
  sinks_.history(history_row(time, report_, now_, progress_.energy));
  sinks_.log(log_line(progress_.steps, time, report_, now_));
  sinks_.progress(std::min(1.0, time / analysis_.duration),
                  fmt::format("{:.2f} of {:g} s, largest displacement {:.3g} m", time, analysis_.duration,
                              now_.displacement));
}

/// Adds the accuracy of the last step to that of the run.
void DynamicRun::include_accuracy(double time) {
  const SolveSummary& solve = report_.solve;
  const bool missed = solve.ending != SolveEnding::converged,
             first_missed = missed && progress_.missed_steps == 0;
  if (first_missed || (missed == (progress_.missed_steps > 0) && !(solve.reached <= progress_.worst_error))) {
    progress_.worst_error = solve.reached;
    progress_.measure = solve.measure;
  }
  progress_.missed_steps += missed ? 1 : 0;
  progress_.rounded_steps += !missed && solve.reached > analysis_.tolerance ? 1 : 0;

  progress_.elastic_steps += report_.elastic_impact > 0.0 ? 1 : 0;
  progress_.elastic_impact = std::max(progress_.elastic_impact, report_.elastic_impact);
  for (const Contact& contact : simulation_.contacts().points)
    progress_.deepest = std::max(progress_.deepest, -contact.gap);
  if (analysis_.adaptive && report_.h <= analysis_.adaptive->smallest &&
      report_.time_error > analysis_.adaptive->displacement_error) {
    ++progress_.coarse_steps;
    progress_.worst_time_error = std::max(progress_.worst_time_error, report_.time_error);
  }

  const ContactSet& contacts = simulation_.contacts();
  std::optional<LawViolation> violation = progress_.worst.violation;
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < report_.violations.size(); ++i) {
    const double value = report_.violations[i];
    if (std::isnan(value) || (violation && value <= violation->value)) continue;
    violation = LawViolation{value, -1, contacts.points[i].block_a, contacts.points[i].block_b, time};
    worst = i;
  }
  if (worst) violation->joint = number_joints(contacts).of_contact[*worst];

  const ContactProblem& problem = report_.problem.problem;
  std::optional<ForceCertificate> certificate;
  if (!report_.step_solution.gamma.isZero(0.0)) certificate = report_.residuals.certificate;
  progress_.worst.include(report_.residuals, certificate, forces_unique(problem, flow_rule(analysis_)),
                          violation, RunStep{progress_.steps, time});
}

Stop DynamicRun::stop_reason() const {
  const double time = simulation_.state().time;
  if (!report_.solve.usable()) return Stop::solver_failed;
  if (is_over(analysis_, progress_.steps, time)) return Stop::time_over;
  if (analysis_.stop.collapsed && progress_.farthest > analysis_.thresholds.collapse())
    return Stop::collapsed;
  const double calm_since = std::max(progress_.calm_since, last_change_);
  if (analysis_.stop.settled_time > 0.0 && time - calm_since >= analysis_.stop.settled_time)
    return Stop::settled;
  return Stop::no;
}

bool DynamicRun::frame_is_due(Stop stop) const {
  if (stop != Stop::no) return true;
  const double every = scene_.output.frames_every;
  if (!analysis_.adaptive) {  // the first step that reaches the time of the next frame
    constexpr double kRounding = 1e-6;
    const auto reached = [&](int steps) {
      return std::floor(steps * analysis_.time_step / every + kRounding);
    };
    return reached(progress_.steps) > reached(progress_.steps - 1);
  }
  const double frames = simulation_.state().time / every;
  return std::abs(frames - std::round(frames)) < 1e-9;
}

Frame DynamicRun::last_frame() const {
  const Model& model = simulation_.model();
  State state = simulation_.state();
  state.v = seen_.v;
  Frame frame = make_frame(model, state, simulation_.contacts(), report_.forces, report_.violations,
                           simulation_.memories(), displacements(*model.assembly, seen_));
  set_role(FrameRole::step, "", &frame);
  state.poses = simulation_.contact_poses();
  set_contact_poses(model, state, &frame);
  built_.list_parted(state, simulation_.contacts(), &frame);
  return frame;
}

std::optional<Summary> DynamicRun::run() {
  const double started = wall_seconds();
  if (progress_.steps == 0) sinks_.history(history_header());
  while (true) {
    step();
    const Stop stop = stop_reason();
    const bool due = frame_is_due(stop);
    if (due) sinks_.frame(last_frame());
    if (stop != Stop::no) return summarize(stop, wall_seconds() - started);
    // A resumed run starts without a factor. To give the same bits, this run drops its factor at every step
    // at which it can be interrupted.
    if (!due && progress_.steps % kStepsPerFactor != 0) continue;
    simulation_.forget_factor();
    const bool interrupted = sinks_.interrupted();
    if (due || interrupted || saving_.is_due()) saving_.run([this] { sinks_.checkpoint(checkpoint()); });
    if (interrupted) return std::nullopt;
  }
}

std::string stop_note(Stop stop, const Analysis& analysis) {
  if (stop == Stop::settled)
    return fmt::format("; settled: all blocks slower than {:.3g} m/s for {:.3g} s", StopRules::kSettledSpeed,
                       analysis.stop.settled_time);
  if (stop == Stop::collapsed) return "; the analysis stopped there";
  return "";
}

Summary DynamicRun::summarize(Stop stop, double seconds) const {
  Summary summary;
  const Frame last = last_frame();
  summarize_frame(last, simulation_.model(), &summary);
  summary.steps = progress_.steps;
  summary.iterations = progress_.iterations;
  summary.time_step_s = report_.h;
  summary.solve_time_seconds = seconds;
  summary.applied_load_N = report_.balance.applied_load;
  summary.support_reaction_N = report_.balance.support_reaction;
  summary.equilibrium_residual = report_.balance.residual;
  summary.inertia_share = report_.balance.inertia_share;
  summary.energy_error = progress_.energy.relative_error();
  summary.final_displacement_m = now_.displacement;
  summary.max_speed_m_per_s = now_.speed;
  progress_.worst.summarize(&summary);
  judge_motion(analysis_, progress_, report_.solve, &summary);
  if (scene_.supports.base_motion && summary.status != Status::unconverged)
    summary.message += "; displacements and speeds are relative to the ground";
  if (!scene_.supports.moves.empty() && summary.status != Status::unconverged)
    summary.message += "; displacements are beyond the moves of supports that blocks follow";
  summary.warnings = motion_warnings(analysis_, progress_);
  summary.message += stop_note(stop, analysis_);
  return summary;
}

}  // namespace

std::optional<Summary> run_dynamic(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  DynamicRun run(scene, assembly, sinks);
  Summary summary;
  if (!sinks.resume_from.empty())
    run.resume(sinks.resume_from);
  else if (run.starts_static() && !run.start_static(&summary))
    return summary;
  return run.run();
}

}  // namespace cupola
