#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/pace.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/byte_archive.hpp"
#include "assembly/files/summary_file.hpp"
#include "assembly/model/block_names.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/path_control.hpp"
#include "solver/analysis/path_row.hpp"
#include "solver/analysis/record/joints_as_built.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/record/record_archive.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {

/// What the steps of a path so far have shown.
struct PathProgress {
  int next = 1;                     // regular step
  double step = 1.0;                // length of the next one, in regular steps
  double time_step = 0.0;           // s, change of the time in the last one
  double first_displacement = 0.0;  // m, of the control at time 0
  double first_load = 0.0;          // N, along the control at time 0, of all blocks if its block is free
  int equilibria = 0, iterations = 0;
  bool proven = true;  // all equilibria
  bool moved = false;  // the last step tried was refused by a proof
  WorstOfRun worst;
  double worst_balance = 0.0, dissipated = 0.0;
  double latest = 0.0;  // s, of all equilibria
  double largest_force = 0.0, time_of_largest = 0.0, displacement_of_largest = 0.0;
  std::string table = path_header();
};

template <class Archive>
void visit(Archive& archive, PathProgress& x) {
  archive(x.next, x.step, x.time_step, x.first_displacement, x.first_load, x.equilibria, x.iterations,
          x.proven, x.moved, x.worst, x.worst_balance, x.dissipated, x.latest, x.largest_force,
          x.time_of_largest, x.displacement_of_largest, x.table);
}

namespace {

constexpr double kShortestStep = 1.0 / 64;  // of a regular one
constexpr double kRounding = 1e-12;         // of times, relative
constexpr double kClose = 0.1;              // part of a step of length that may be missing

/// The equilibria of a path, one after the other. Its parameter is the time, or the length: the displacement
/// of the control from that at time 0.
class PathRun {
 public:
  PathRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);
  std::optional<Summary> run();

 private:
  double displacement() const;
  bool has_free_control() const { return model_.free_index[control_.block] != ContactProblem::kFixed; }
  /// N, of the control along its direction.
  double force_along(const StaticSolution& solution) const {
    return control_force(model_, path_, solution, control_.block).dot(control_.direction);
  }
  double parameter() const {
    return options_.length ? displacement() - progress_.first_displacement : path_.value();
  }
  bool is_end(double time) const { return time > (1.0 - kRounding) * options_.end; }
  bool bears_all_loads() const;
  bool advance(double parameter);
  bool refuse(StaticOutcome outcome, bool proven, double parameter, const std::string& reason);
  void record(const StaticSolution& solution);
  void tabulate(const Frame& frame, const StaticSolution& solution);
  std::string checkpoint() const;
  void resume();
  void judge(double started);

  const LoadPath& options_;
  const AnalysisSinks& sinks_;
  const Model model_;
  const JointsAsBuilt built_;
  EquilibriumPath path_;
  LengthControl control_;  // without displacement and time step
  Summary summary_;
  PathProgress progress_;
  std::string last_failure_;
  bool came_back_ = false;  // the last step failed at the time 0, after equilibria at later ones
  Status last_status_ = Status::stable;
  Pace saving_;
};

PathRun::PathRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks)
    : options_(scene.analysis.path),
      sinks_(sinks),
      model_(make_model(scene, assembly)),
      built_(model_, detection_options(scene)),
      path_(model_, detection_options(scene), static_options(scene.analysis), scene.analysis.path.geometry),
      control_(path_control(scene.analysis.path, model_)) {
  progress_.time_step = options_.end / options_.steps;
}

/// Of the control along its direction, m.
double PathRun::displacement() const {
  const auto along = [this](int block) {
    return (path_.state().poses[block].p_WB - model_.assembly->blocks[block].centroid)
        .dot(control_.direction);
  };
  return along(control_.block) - (control_.relative_to >= 0 ? along(control_.relative_to) : 0.0);
}

/// One step to `parameter`; true if it finds an equilibrium. After a step that was proven to move, the conic
/// solver is asked first, since shorter steps mostly move too.
bool PathRun::advance(double parameter) {
  if (progress_.moved && !options_.length && path_.surely_moves_at(parameter))
    return refuse(StaticOutcome::moving, true, parameter,
                  "no equilibrium exists: a mechanism that the loads drive and no joint resists proves it");
  const double time = path_.value();
  StaticSolution solution;
  if (options_.length && progress_.equilibria > 0) {
    control_.displacement = control_.length = parameter - this->parameter();
    control_.time_step = progress_.time_step;
    solution = path_.advance_by(control_);
  } else {
    solution = path_.advance(options_.length ? 0.0 : parameter);
  }
  progress_.iterations += solution.iterations;
  last_status_ = status_of(solution.outcome, solution.proven);
  progress_.moved = last_status_ == motion(true);
  if (solution.outcome == StaticOutcome::equilibrium) {
    if (path_.value() != time) progress_.time_step = std::abs(path_.value() - time);
    record(solution);
    return true;
  }
  came_back_ = options_.length && progress_.latest > 0.0 &&
               path_.start().time + solution.time_advance <= kRounding * options_.end;
  if (progress_.equilibria == 0) {
    const Frame frame =
        static_frame(model_, path_.start(), path_.contacts(), path_.memories(), solution, path_.options());
    sinks_.frame(frame);
    summarize_static(solution, frame, model_, path_.options().tolerance, &summary_);
  }
  return refuse(solution.outcome, solution.proven, parameter, solution.message);
}

/// No equilibrium at `parameter`. Returns false.
bool PathRun::refuse(StaticOutcome outcome, bool proven, double parameter, const std::string& reason) {
  last_status_ = status_of(outcome, proven);
  last_failure_ =
      fmt::format("{} at {:.6g} {}: {}", to_string(outcome), parameter, options_.length ? "m" : "s", reason);
  sinks_.log(last_failure_);
  return false;
}

void PathRun::record(const StaticSolution& solution) {
  Frame frame =
      static_frame(model_, path_.start(), path_.contacts(), path_.memories(), solution, path_.options());
  set_role(FrameRole::path, "", &frame);
  set_contact_poses(model_, path_.start(), &frame);
  built_.list_parted(path_.state(), path_.contacts(), &frame);
  sinks_.frame(frame);
  summarize_static(solution, frame, model_, path_.options().tolerance, &summary_);
  std::optional<ForceCertificate> certificate;
  if (!solution.step_solution.gamma.isZero(0.0)) certificate = summary_.certified_force_error;
  progress_.worst.include(solution.residuals, certificate, summary_.forces_unique, largest_violation(frame));
  progress_.worst_balance = std::max(progress_.worst_balance, summary_.accuracy.reached);
  progress_.proven = progress_.proven && solution.proven;
  progress_.dissipated += path_.dissipated();
  progress_.latest = std::max(progress_.latest, path_.value());
  if (progress_.equilibria++ == 0) {
    progress_.first_displacement = displacement();
    if (has_free_control()) progress_.first_load = force_along(solution);
  }
  tabulate(frame, solution);
}

void PathRun::tabulate(const Frame& frame, const StaticSolution& solution) {
  const double force = force_along(solution) - progress_.first_load;
  const PathRow row{path_.value(),
                    displacement(),
                    force,
                    progress_.dissipated,
                    mean_damage(frame.contacts),
                    path_.solves(),
                    widest_gap(frame.contacts)};
  if (std::abs(force) > std::abs(progress_.largest_force)) {
    progress_.largest_force = force;
    progress_.time_of_largest = row.time;
    progress_.displacement_of_largest = row.displacement;
  }
  progress_.table += path_line(row);
  sinks_.table("path.csv", progress_.table);
  const std::string line =
      fmt::format("time {:9.4g} s  displacement {:11.4e} m  force {:11.4e} N  damage {:6.4f}  {}", row.time,
                  row.displacement, row.force, row.mean_damage, counted(row.solves, "solve"));
  sinks_.log(line);
  sinks_.progress(parameter() / options_.length.value_or(options_.end), line);
}

std::string PathRun::checkpoint() const {
  PathProgress progress = progress_;
  std::string path = path_.save(), summary = to_json(summary_);
  ByteWriter archive;
  archive(path, progress, summary);
  return archive.bytes();
}

void PathRun::resume() {
  std::string path, summary;
  ByteReader archive(sinks_.resume_from);
  archive(path, progress_, summary);
  path_.restore(path);
  summary_ = summary_from_json(summary, "checkpoint");
}

/// False of a path by a length whose loads change after the latest of its times.
bool PathRun::bears_all_loads() const {
  const auto loads = [this](double time) { return applied_forces(model_, path_.state(), time); };
  return !options_.length || is_end(progress_.latest) || loads(progress_.latest) == loads(options_.end);
}

void PathRun::judge(double started) {
  summary_.steps = progress_.equilibria;
  summary_.iterations = progress_.iterations;
  summary_.solve_time_seconds = wall_seconds() - started;
  progress_.worst.summarize(&summary_);
  summary_.accuracy.worst_over_run = progress_.worst_balance;
  const Vec3 along = (1e3 * control_.direction).array().round() / 1e3 + 0.0;  // no -0
  const std::string chosen =
      options_.control ? "" : fmt::format(", chosen, along ({:g}, {:g}, {:g})", along[0], along[1], along[2]);
  const bool no_load = has_free_control() && progress_.largest_force == 0.0;  // supports or heat alone
  const std::string largest =
      no_load
          ? "no load was added"
          : fmt::format("largest {} {:.6g} N at {:.6g} {} (block {}{})",
                        has_free_control() ? "added load" : "force", progress_.largest_force,
                        options_.length ? progress_.displacement_of_largest : progress_.time_of_largest,
                        options_.length ? "m" : "s", block_label(*model_.assembly, control_.block), chosen);
  const std::string reached = options_.length ? fmt::format("{:.6g} m, at {:.4g} s of {:g} s", displacement(),
                                                            path_.value(), options_.end)
                                              : fmt::format("{:.6g} s", path_.value());
  if (stands(last_status_) || came_back_) {
    summary_.status = standing(progress_.proven);
    if (!bears_all_loads()) summary_.bears_loads_until_s = progress_.latest;
    summary_.message = fmt::format(
        "{} up to {}; {}", counted(progress_.equilibria, "equilibrium", "equilibria"), reached, largest);
    if (came_back_)
      summary_.message += fmt::format(
          "; before the length of the path, {:g} m, the loads came back to those at 0 s: beyond, the "
          "structure moves by itself",
          *options_.length);
    else if (options_.length && is_end(path_.value()))
      summary_.message += fmt::format("; the latest time, {:g} s, came before the length of the path, {:g} m",
                                      options_.end, *options_.length);
    return;
  }
  summary_.status = last_status_;
  summary_.message = progress_.equilibria == 0
                         ? fmt::format("the path has no equilibrium; {}", last_failure_)
                         : fmt::format("the path ends at {}; {}; {}", reached, largest, last_failure_);
}

std::optional<Summary> PathRun::run() {
  const double started = wall_seconds();
  if (!sinks_.resume_from.empty()) {
    resume();
  } else if (!advance(0.0)) {
    judge(started);
    return summary_;
  }
  const double regular = options_.length.value_or(options_.end) / options_.steps;
  while (progress_.next <= options_.steps) {
    const bool interrupted = sinks_.interrupted();
    if (interrupted || saving_.is_due()) saving_.run([this] { sinks_.checkpoint(checkpoint()); });
    if (interrupted) return std::nullopt;
    // The times of regular steps are exact; shorter ones lead to them. A length may be missed a little.
    double& step = progress_.step;
    const double target = regular * progress_.next;
    const bool reaches = parameter() + 1.001 * step * regular >= target;
    if (advance(reaches ? target : parameter() + step * regular)) {
      const bool there = options_.length ? parameter() > target - kClose * step * regular : reaches;
      progress_.next += there ? 1 : 0;
      step = std::min(1.0, 2.0 * step);
      if (options_.length && is_end(path_.value())) break;
    } else if ((step *= 0.5) < kShortestStep) {
      break;
    }
  }
  judge(started);
  return summary_;
}

}  // namespace

std::optional<Summary> run_path(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  return PathRun(scene, assembly, sinks).run();
}

}  // namespace cupola
