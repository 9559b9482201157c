#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/model/block_names.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/dynamics/energy_account.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
namespace {

constexpr double kShortestStep = 1.0 / 64;  // of a regular one

/// The force that a support exerts on the blocks, or the loads on all blocks if the control block is free.
Vec3 control_force(const Model& model, const ContactSet& contacts, const StaticSolution& solution,
                   int block) {
  if (model.free_index[block] != ContactProblem::kFixed) return solution.balance.applied_load;
  Vec3 force = Vec3::Zero();
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    if (contacts.points[i].block_a == block) force += solution.forces.contacts[i];
    if (contacts.points[i].block_b == block) force -= solution.forces.contacts[i];
  }
  return force;
}

/// The equilibria of a path, one after the other.
class PathRun {
 public:
  PathRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks)
      : analysis_(scene.analysis),
        sinks_(sinks),
        model_(make_model(scene, assembly)),
        path_(model_, detection_options(scene), static_options(scene.analysis)) {
    const LoadPath::Control& control = *analysis_.path.control;
    block_ = control.block;
    direction_ = control.direction.normalized();
    if (block_ >= static_cast<int>(assembly.blocks.size()))
      throw InputError(
          fmt::format("analysis.path.control: block {} does not exist: the assembly has blocks 0 to {}",
                      block_, assembly.blocks.size() - 1));
  }
  std::optional<Summary> run();

 private:
  bool advance(double time);
  void record(const StaticSolution& solution);
  void judge(double started);

  const Analysis& analysis_;
  const AnalysisSinks& sinks_;
  const Model model_;
  EquilibriumPath path_;
  int block_ = 0;
  Vec3 direction_;
  Summary summary_;
  WorstOfRun worst_;
  double worst_balance_ = 0.0, dissipated_ = 0.0, largest_force_ = 0.0, time_of_largest_ = 0.0;
  int equilibria_ = 0, iterations_ = 0;
  std::string last_failure_;
  StaticOutcome last_outcome_ = StaticOutcome::equilibrium;
  std::string table_ = "time_s,displacement_m,force_N,dissipated_J,mean_damage,solves\n";
};

/// One static solve at `time`; true if it finds an equilibrium.
bool PathRun::advance(double time) {
  StaticSolution solution = path_.advance(time);
  iterations_ += solution.iterations;
  last_outcome_ = solution.outcome;
  if (solution.outcome == StaticOutcome::equilibrium) {
    record(solution);
    return true;
  }
  if (equilibria_ == 0) {
    const Frame frame =
        static_frame(model_, path_.start(), path_.contacts(), path_.memories(), solution, path_.options());
    sinks_.frame(frame);
    summarize_static(solution, frame, model_, path_.options().tolerance, &summary_);
  }
  last_failure_ = fmt::format("{} at {:.6g} s: {}", to_string(solution.outcome), time, solution.message);
  sinks_.log(last_failure_);
  return false;
}

void PathRun::record(const StaticSolution& solution) {
  const Frame frame =
      static_frame(model_, path_.start(), path_.contacts(), path_.memories(), solution, path_.options());
  sinks_.frame(frame);
  summarize_static(solution, frame, model_, path_.options().tolerance, &summary_);
  worst_.include(solution.residuals, summary_.certified_force_error, summary_.forces_unique,
                 largest_violation(frame));
  worst_balance_ = std::max(worst_balance_, summary_.accuracy.reached);
  dissipated_ += joint_dissipation(solution.step, solution.step_solution);
  ++equilibria_;

  const Block& block = model_.assembly->blocks[block_];
  const double displacement = (path_.state().poses[block_].p_WB - block.centroid).dot(direction_);
  const double force = control_force(model_, path_.contacts(), solution, block_).dot(direction_);
  if (std::abs(force) > std::abs(largest_force_)) {
    largest_force_ = force;
    time_of_largest_ = path_.value();
  }
  double damage = 0.0, area = 0.0;
  for (int i = 0; i < frame.contacts.size() && !frame.contacts.damage.empty(); ++i) {
    damage += frame.contacts.area[i] * frame.contacts.damage[i];
    area += frame.contacts.area[i];
  }
  const double mean_damage = area > 0.0 ? damage / area : 0.0;
  table_ += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{}\n", path_.value(), displacement, force,
                        dissipated_, mean_damage, path_.solves());
  sinks_.table("path.csv", table_);
  const std::string line =
      fmt::format("time {:9.4g} s  displacement {:11.4e} m  force {:11.4e} N  damage {:6.4f}  {}",
                  path_.value(), displacement, force, mean_damage, counted(path_.solves(), "solve"));
  sinks_.log(line);
  sinks_.progress(path_.value() / analysis_.path.end, line);
}

void PathRun::judge(double started) {
  summary_.steps = equilibria_;
  summary_.iterations = iterations_;
  summary_.solve_time_seconds = wall_seconds() - started;
  worst_.summarize(&summary_);
  summary_.accuracy.worst_over_run = worst_balance_;
  const std::string largest = fmt::format("largest force {:.6g} N at {:.6g} s (block {})", largest_force_,
                                          time_of_largest_, block_label(*model_.assembly, block_));
  if (last_outcome_ == StaticOutcome::equilibrium) {
    summary_.message = fmt::format("{} up to {:.6g} s; {}", counted(equilibria_, "equilibrium", "equilibria"),
                                   path_.value(), largest);
    return;
  }
  summary_.status = last_outcome_ == StaticOutcome::moving ? Status::moving : Status::unconverged;
  summary_.message = fmt::format("the path ends at {:.6g} s; {}; {}", path_.value(), largest, last_failure_);
}

std::optional<Summary> PathRun::run() {
  const double started = wall_seconds();
  const double regular = analysis_.path.end / analysis_.path.steps;
  if (!advance(0.0)) {
    judge(started);
    return summary_;
  }
  double step = regular;
  for (int next = 1; next <= analysis_.path.steps;) {
    if (sinks_.interrupted()) return std::nullopt;
    // The times of regular steps are exact; shorter ones lead to them.
    const double target = regular * next;
    const bool reaches = path_.value() + 1.001 * step >= target;
    if (advance(reaches ? target : path_.value() + step)) {
      next += reaches ? 1 : 0;
      step = std::min(regular, 2.0 * step);
    } else if ((step *= 0.5) < kShortestStep * regular) {
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
