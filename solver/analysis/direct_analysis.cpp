#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/model/thickness.hpp"
#include "solver/analysis/direct_limit.hpp"
#include "solver/analysis/mechanism.hpp"
#include "solver/analysis/record.hpp"
#include "solver/analysis/static_solve.hpp"

namespace cupola {
namespace {

constexpr double kWidth = 1e-5;  // relative; loads reach 1e-7 unless the structure is very slender
const char* const kDirectHistory = "value,admissible,pull,iterations";

double degrees(double tangent) {
  return std::atan(tangent) * 180.0 / std::numbers::pi;
}

/// The search of a tilt in its tangent, with all loads over its cosine: weights are then linear in it, and a
/// factor on all loads changes no limit.
DirectLimit limit_of_tilt(const SceneAt& scene_at, double low, double high, const ReportTrial& report) {
  const auto tangent = [](double angle) {
    constexpr double kSteepest = 89.0;  // degrees
    return std::tan(std::clamp(angle, -kSteepest, kSteepest) * std::numbers::pi / 180.0);
  };
  const auto at_tangent = [&](double t) {
    RigidScene scene = scene_at(degrees(t));
    scene.problem.load *= std::hypot(1.0, t);
    return scene;
  };
  const auto in_degrees = [&](DirectTrial trial) {
    trial.value = degrees(trial.value);
    report(trial);
  };
  DirectLimit limit = limit_of_loads(at_tangent, tangent(low), tangent(high), kWidth, in_degrees);
  if (!limit.found) return limit;
  limit.gamma /= std::hypot(1.0, limit.admissible);
  limit.admissible = degrees(limit.admissible);
  limit.moving = degrees(limit.moving);
  return limit;
}

DirectLimit search(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const LimitSearch& limit = scene.analysis.limit;
  const auto scene_at = [&](double value) {
    auto at = limit.parameter == LimitSearch::Parameter::thickness
                  ? std::make_shared<const Assembly>(with_thickness(assembly, value))
                  : std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {});
    const bool shrinks = limit.parameter == LimitSearch::Parameter::joint_extent;
    return rigid_scene(case_at(scene, value), std::move(at), shrinks ? value : 1.0);
  };
  int trials = 0;
  const auto report = [&](const DirectTrial& trial) {
    const std::string pull = trial.pull ? fmt::format("{:.2e}", *trial.pull) : "";
    sinks.log(fmt::format("trial {:3d}  {} {:14.10g}  {:<10}  iterations {:3d}{}{}", ++trials,
                          to_string(limit.parameter), trial.value, trial.admissible ? "admissible" : "moves",
                          trial.iterations, trial.pull ? "  pull needed " : "", pull));
    sinks.history(
        fmt::format("{:.17g},{},{},{}", trial.value, trial.admissible ? 1 : 0, pull, trial.iterations));
  };
  using Parameter = LimitSearch::Parameter;
  switch (limit.parameter) {
    case Parameter::tilt:
      return limit_of_tilt(scene_at, limit.low, limit.high, report);
    case Parameter::load:
    case Parameter::acceleration:
      return limit_of_loads(scene_at, limit.low, limit.high, kWidth, report);
    case Parameter::friction:
    case Parameter::thickness:
    case Parameter::joint_extent:
      return limit_of_joints(scene_at, limit.low, limit.high, kWidth, limit.parameter == Parameter::friction,
                             report);
    case Parameter::spread:
      break;  // follows displacements: uses_direct_limit() is false
  }
  throw std::logic_error("a direct limit analysis of a spread");
}

/// Writes the admissible state and the mechanism as frames. Returns a description of the mechanism.
std::string write_ends(const DirectLimit& limit, const AnalysisSinks& sinks, Summary* summary) {
  const RigidScene& stable = limit.at_admissible;
  const Frame frame = admissible_frame(stable, limit.gamma, stable.start.time);
  sinks.frame(frame);
  summarize_frame(frame, stable.model, summary);
  summarize_balance(balance_of(stable, limit.gamma), summary);

  const RigidScene& moving = limit.at_moving;
  const Mechanism mechanism =
      find_mechanism(moving.model, moving.start, moving.contacts, moving.problem.contacts, limit.mechanism);
  if (moving.contacts.points.size() == stable.contacts.points.size())
    write_mechanism(moving.model, moving.start, moving.contacts, moving.memories, mechanism,
                    frame.contacts.force, frame.contacts.law_violation, sinks);
  return describe(mechanism);
}

/// Coulomb's law admits the same forces but does not let every such state stand.
std::string bound_for_coulomb(const DirectLimit& limit) {
  return fmt::format("; under Coulomb's law the critical value is the same or {}",
                     limit.moving < limit.admissible ? "larger" : "smaller");
}

}  // namespace

std::optional<Summary> run_direct_limit(const Case& scene, const Assembly& assembly,
                                        const AnalysisSinks& sinks) {
  const std::string name = to_string(scene.analysis.limit.parameter);
  const double started = wall_seconds();
  sinks.history(kDirectHistory);
  const DirectLimit limit = search(scene, assembly, sinks);

  Summary summary;
  summary.steps = limit.trials;
  summary.iterations = limit.iterations;
  summary.accuracy = {"critical value", "width of its bracket, relative to the middle", kWidth};
  summary.certified_force_error.bounds = "no equilibrium was found";
  summary.forces_unique = {false, "no equilibrium was found"};
  summary.status = Status::unconverged;
  summary.message = name + ": " + limit.message;
  if (limit.found) {
    summary.certified_force_error.bounds = "the forces at a limit are one of the admissible states";
    summary.forces_unique = {false, "they are one of the admissible states at the critical value"};
    const std::string mechanism = write_ends(limit, sinks, &summary);
    const double width = limit.relative_width();
    summary.accuracy.reached = summary.accuracy.worst_over_run = width;
    // Recomputed from points and world forces: what the solver calls admissible must balance.
    const bool balanced = summary.equilibrium_residual.value() <= kOutcomeTolerance;
    if (width <= kWidth && balanced) summary.status = Status::stable;
    summary.critical = CriticalValue{name, limit.middle(), limit.admissible, limit.moving};
    const std::string unit = limit_unit(name);
    summary.message = fmt::format("{}{}: {} at {:.8g}, a mechanism at {:.8g} (relative width {:.1e}){}; {}",
                                  name, unit.empty() ? "" : " (" + unit + ")",
                                  balanced ? "an admissible state" : "forces that do not balance the loads",
                                  limit.admissible, limit.moving, width, limit.message, mechanism) +
                      bound_for_coulomb(limit);
  }
  summary.solve_time_seconds = wall_seconds() - started;
  return summary;
}

}  // namespace cupola
