#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/files/csv_columns.hpp"
#include "assembly/model/thickness.hpp"
#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/analysis/record/mechanism.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/motion_proof.hpp"
#include "solver/conic/solve_conic.hpp"

namespace cupola {
namespace {

/// history.csv: one row per conic programme.
constexpr CsvColumn<DirectTrial> kDirectColumns[] = {
    {"value", [](const DirectTrial& t) { return fmt::format("{:.17g}", t.value); }},
    {"admissible",
     [](const DirectTrial& t) {
       return std::string(!t.admissible ? "" : *t.admissible ? "1" : "0");
     }},
    {"pull", [](const DirectTrial& t) { return t.pull ? fmt::format("{:.2e}", *t.pull) : ""; }},
    {"iterations", [](const DirectTrial& t) { return std::to_string(t.iterations); }},
};

double degrees(double tangent) {
  return std::atan(tangent) * 180.0 / std::numbers::pi;
}

/// The search of a tilt in its tangent, with all loads over its cosine: weights are then linear in it, and a
/// factor on all loads changes no limit of dry joints.
DirectLimit limit_of_tilt(const SceneAt& scene_at, double low, double high, double width,
                          const ReportTrial& report) {
  const auto tangent = [](double angle) { return std::tan(angle * std::numbers::pi / 180.0); };
  const auto at_tangent = [&](double t) {
    RigidScene scene = scene_at(degrees(t));
    scene.problem.load *= std::hypot(1.0, t);
    return scene;
  };
  const auto in_degrees = [&](DirectTrial trial) {
    trial.value = degrees(trial.value);
    report(trial);
  };
  DirectLimit limit = limit_of_loads(at_tangent, tangent(low), tangent(high), width, in_degrees, degrees);
  if (!limit.found) return limit;
  limit.gamma /= std::hypot(1.0, limit.admissible);
  limit.admissible = degrees(limit.admissible);
  limit.moving = degrees(limit.moving);
  limit.span = high - low;
  return limit;
}

/// True where that search applies: no strength is scaled, and no end is near the vertical, where the tangent
/// ends.
bool has_tangents_of_dry_joints(const Case& scene) {
  constexpr double kSteepest = 89.0;  // degrees
  const LimitSearch& limit = scene.analysis.limit;
  return !scene.joints.have_strength() && !scene.ties_yield() &&
         std::max(std::abs(limit.low), std::abs(limit.high)) <= kSteepest;
}

DirectLimit search(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const LimitSearch& limit = scene.analysis.limit;
  const double width = bracket_width(scene.analysis);
  const auto scene_at = [&](double value) {
    auto at = limit.parameter == LimitSearch::Parameter::thickness
                  ? std::make_shared<const Assembly>(with_thickness(assembly, value))
                  : std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {});
    const bool shrinks = limit.parameter == LimitSearch::Parameter::joint_extent;
    return rigid_scene(case_at(scene, value), std::move(at), shrinks ? value : 1.0,
                       limit.parameter == LimitSearch::Parameter::peak_stress);
  };
  int trials = 0;
  const auto report = [&](const DirectTrial& trial) {
    sinks.log(fmt::format("trial {:3d}  {} {:14.10g}  {:<10}  iterations {:3d}{}", ++trials,
                          to_string(limit.parameter), trial.value,
                          !trial.admissible   ? "undecided"
                          : *trial.admissible ? "admissible"
                                              : "moves",
                          trial.iterations,
                          trial.pull ? fmt::format("  pull needed {:.2e}", *trial.pull) : ""));
    sinks.history(csv_row(kDirectColumns, trial));
  };
  using Parameter = LimitSearch::Parameter;
  switch (limit.parameter) {
    case Parameter::tilt:
      if (has_tangents_of_dry_joints(scene))
        return limit_of_tilt(scene_at, limit.low, limit.high, width, report);
      [[fallthrough]];
    case Parameter::acceleration:
    case Parameter::lantern:
      return limit_of_loads(scene_at, limit.low, limit.high, width, report);
    case Parameter::load:
      return limit_of_loads(scene_at, limit.low, limit.high, width, report, std::identity{},
                            own_value(scene));
    case Parameter::friction:
    case Parameter::thickness:
    case Parameter::joint_extent:
      return limit_of_joints(scene_at, limit.low, limit.high, width, limit.parameter, report);
    case Parameter::peak_stress:
      return least_peak_stress(scene, scene_at(0.0), report);
    case Parameter::spread:
      break;  // follows displacements: uses_direct_limit() is false
  }
  throw std::logic_error("a direct limit analysis of a spread");
}

/// Writes the mechanism of a structure that moves at every value tried, and returns its description. `gravity`
/// as in write_ends().
std::string write_motion(const DirectLimit& limit, const std::string& parameter, double gravity,
                         const AnalysisSinks& sinks, Summary* summary) {
  const RigidScene& moving = limit.at_moving;
  const Mechanism mechanism =
      find_mechanism(moving.model, moving.start, moving.contacts, moving.problem.contacts, limit.mechanism);
  const size_t nc = moving.contacts.points.size();
  const VecX none = VecX::Zero(static_cast<Eigen::Index>(3 * moving.problem.contacts.num_contacts()));
  summarize_frame(admissible_frame(moving, none, moving.start.time), moving.model, summary);
  summary->applied_load_N = balance_of(moving, none).applied_load;
  summary->weight_N = free_weight(*moving.assembly, gravity);
  write_mechanism(moving.model, moving.start, moving.contacts, moving.memories, mechanism,
                  {std::vector<Vec3>(nc, Vec3::Zero()), {}}, std::vector<double>(nc, 0.0), parameter, sinks);
  return describe(mechanism);
}

/// Writes the admissible state and the mechanism as frames. Returns a description of the mechanism, "" without
/// one. `gravity`: m/s2, without a horizontal acceleration that the search adds.
std::string write_ends(const DirectLimit& limit, const std::string& parameter, double gravity,
                       const AnalysisSinks& sinks, Summary* summary) {
  const RigidScene& stable = limit.at_admissible;
  Frame frame = admissible_frame(stable, limit.gamma, stable.start.time);
  set_role(FrameRole::equilibrium, parameter, &frame);
  sinks.frame(frame);
  summarize_frame(frame, stable.model, summary);
  summarize_balance(balance_of(stable, limit.gamma), summary);
  summary->weight_N = free_weight(*stable.assembly, gravity);
  summary->certified_force_error.bounds = "the forces at a limit are one of the admissible states";
  summary->forces_unique = {false, ForcesUnique::kOneOfMany};

  if (limit.mechanism.size() == 0) return "";
  const RigidScene& moving = limit.at_moving;
  const Mechanism mechanism =
      find_mechanism(moving.model, moving.start, moving.contacts, moving.problem.contacts, limit.mechanism);
  if (moving.contacts.points.size() == stable.contacts.points.size())
    write_mechanism(moving.model, moving.start, moving.contacts, moving.memories, mechanism,
                    {frame.contacts.force, frame.ties.force}, frame.contacts.law_violation, parameter, sinks);
  return describe(mechanism);
}

/// Writes the assembly without forces: the search showed nothing.
void write_nothing_found(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks,
                         Summary* summary) {
  const RigidScene own =
      rigid_scene(scene, std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {}));
  Frame frame = admissible_frame(own, VecX::Zero(own.problem.cost.size()), own.start.time);
  set_role(FrameRole::unconverged, "", &frame);
  sinks.frame(frame);
  summarize_frame(frame, own.model, summary);
}

/// What proves the critical value from both sides.
std::string bounds_text(const DirectLimit& limit, bool balanced) {
  const std::string state =
      fmt::format("{} at {:.8g}", balanced ? "an admissible state" : "forces that do not balance the loads",
                  limit.admissible);
  const std::string unproven =
      fmt::format("{} forces of up to {:.3g} times those found",
                  limit.mechanism.size() > 0 ? " against" : " among", limit.resisting_forces);
  const std::string other =
      fmt::format("{} {:.8g}{}", limit.mechanism.size() > 0 ? "a mechanism at" : "none below", limit.moving,
                  limit.motion_proven ? "" : unproven);
  return fmt::format("{}, {} (relative width {:.1e})", state, other, limit.relative_width());
}

/// Coulomb's law admits the same forces but does not let every such state stand.
std::string bound_for_coulomb(const DirectLimit& limit) {
  return fmt::format("under Coulomb's law the critical value is the same or {}",
                     limit.moving < limit.admissible ? "larger" : "smaller");
}

/// Without a critical value no value that the search tried stands out: the case itself is solved. The status
/// is its own where it does what both ends of the search do. If it stands, its forces are shown.
void summarize_not_found(const Case& scene, const Assembly& assembly, DirectLimit limit,
                         const AnalysisSinks& sinks, Summary* summary) {
  const std::string name = to_string(scene.analysis.limit.parameter);
  Sought sought = std::move(limit.sought);
  std::string mechanism;
  summary->stands_at_both_ends = limit.stands_at_both_ends;
  const bool stands = limit.gamma.size() > 0, moves = limit.mechanism.size() > 0;
  const double gravity = scene.loads.gravity.norm();
  RigidScene own = rigid_scene(scene, std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {}));
  ConicSolution of_case;
  if (stands || moves) of_case = solve_conic(own.problem);
  if (of_case.outcome == ConicOutcome::optimal) {
    limit.at_admissible = std::move(own);
    limit.gamma = of_case.gamma;
    limit.mechanism.resize(0);
    write_ends(limit, name, gravity, sinks, summary);
    // Recomputed from points and world forces: what the solver calls admissible must balance.
    const bool balanced = summary->equilibrium_residual.value() <= kOutcomeTolerance;
    if (balanced && stands) summary->status = Status::stable;
    if (balanced && moves) add_clause("the case itself stands", &sought.also);
  } else if (moves) {
    if (of_case.outcome == ConicOutcome::infeasible) {
      summary->status =
          motion(MotionProof(own.problem.contacts, own.problem.load).next_to(of_case.v).has_value());
      limit.at_moving = std::move(own);
      limit.mechanism = of_case.v;
    }
    mechanism = write_motion(limit, name, gravity, sinks, summary);
  } else {
    write_nothing_found(scene, assembly, sinks, summary);
  }
  summary->message = fmt::format("{}{}: {}{}{}", name, varied_joints(scene.analysis.limit), sought.found,
                                 sought.found.empty() ? "" : ": ", clauses(sought));
  add_clause(mechanism, &summary->message);
  summary->sought = concluded(std::move(sought), summary->status);
}

void summarize_found(const Case& scene, const DirectLimit& limit, const AnalysisSinks& sinks,
                     Summary* summary) {
  const std::string name = to_string(scene.analysis.limit.parameter);
  const std::string mechanism = write_ends(limit, name, scene.loads.gravity.norm(), sinks, summary);
  const double width = limit.relative_width(), asked = summary->accuracy.asked;
  summary->accuracy.reached = summary->accuracy.worst_over_run = width;
  if (limit.is_zero()) summary->accuracy.norm = kNormOfZero;
  const bool balanced = summary->equilibrium_residual.value() <= kOutcomeTolerance;  // as above
  if (balanced) summary->status = width <= asked ? Status::stable : Status::bracketed;
  summary->critical = CriticalValue{name, limit.middle(), limit.admissible, limit.moving};
  Sought sought = limit.sought;
  sought.reason = bounds_text(limit, balanced);
  add_clause(limit.sought.reason, &sought.reason);
  summary->message = critical_text(*summary->critical) + varied_joints(scene.analysis.limit);
  for (const std::string& clause : {clauses(sought), mechanism, bound_for_coulomb(limit)})
    add_clause(clause, &summary->message);
  summary->sought = std::move(sought);
  if (width > asked) summary->message += missed_width(width, asked);
}

}  // namespace

std::optional<Summary> run_direct_limit(const Case& scene, const Assembly& assembly,
                                        const AnalysisSinks& sinks) {
  const double started = wall_seconds();
  sinks.history(csv_header(kDirectColumns));
  const DirectLimit limit = search(scene, assembly, sinks);

  Summary summary;
  summary.status = Status::unconverged;
  summary.steps = limit.trials;
  summary.iterations = limit.iterations;
  summary.accuracy = {"critical value", "width of its bracket, relative to the middle",
                      bracket_width(scene.analysis)};
  summary.certified_force_error.bounds = "no equilibrium was found";
  summary.forces_unique = {false, "no equilibrium was found"};
  if (limit.found)
    summarize_found(scene, limit, sinks, &summary);
  else
    summarize_not_found(scene, assembly, limit, sinks, &summary);
  summary.sought->quantity = critical_quantity(scene.analysis.limit);
  const RigidScene& stands = limit.at_admissible;
  summary.message += gaps_note(stands.model, stands.start, stands.contacts);
  summary.solve_time_seconds = wall_seconds() - started;
  return summary;
}

}  // namespace cupola
