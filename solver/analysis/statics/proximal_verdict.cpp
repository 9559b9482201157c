#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "solver/analysis/statics/coming_to_rest.hpp"
#include "solver/contact/problem/kinematic_bound.hpp"

namespace cupola {
namespace {

/// Lower bound of the sum of normal forces of any equilibrium, over the sum found or the sum of the loads if
/// that is larger, from which a proof of the motion is sought and, failing that, a motion without proof is
/// reported.
constexpr double kFarFromEquilibrium = 100.0;

/// A lower bound with two digits, rounded down.
std::string times_text(double times) {
  constexpr double kReadable = 1e6;
  if (times > kReadable) return "a million";
  const double digit = std::pow(10.0, std::floor(std::log10(std::max(times, 1.0))) - 1.0);
  return fmt::format("{:g}", std::floor(times / digit) * digit);
}

/// `required`: as of required_forces().
std::string unproven_text(double required) {
  if (std::isinf(required))
    return "up to rounding, no forces within the limits of the joints resist this motion";
  return fmt::format(
      "contact forces that balance the loads would have to be at least {} times as large as the loads",
      times_text(required));
}

}  // namespace

/// Lower bound of the sum of the normal forces of any equilibrium, from the motion, over the larger of the
/// sum found and the sum of the loads. Infinite where no forces within the limits of the joints balance them.
double ComingToRest::required_forces() const {
  double loads = 0.0;
  const VecX f = applied_forces(model_, start_, start_.time + options_.time_advance);
  for (Eigen::Index i = 0; i < f.size(); i += 6) loads += f.segment<3>(i).norm();
  return required_normal_force(step_.problem, trial_.increment / trial_.h) /
         std::max(loads, normal_force_sum(step_.problem, trial_.step_solution.gamma));
}

/// True if the motion, or one that the conic solver finds, proves that no forces balance the loads.
bool ComingToRest::is_proven_to_move() {
  if (!motion_proof_)
    motion_proof_.emplace(
        step_.problem, step_.problem.h * applied_forces(model_, start_, start_.time + options_.time_advance));
  return motion_proof_->next_to(trial_.increment) || motion_proof_->search() == MotionProof::Answer::moves;
}

/// True if `count` iterations in a row left the residual as it was and the blocks move.
bool ComingToRest::moves_steadily(double contraction, int count) {
  constexpr double kSteady = 0.05;
  const bool steady = std::abs(contraction - 1.0) < kSteady && trial_.speed_ratio > kAtRest;
  num_steady_ = steady ? num_steady_ + 1 : 0;
  return num_steady_ >= count;
}

/// True if the loads do more work on the motion than violations of the contact law at rigid contacts may.
/// Where normal forces F alone balance the loads f, f . v = -F . D^T v is positive only by contacts that
/// approach each other: by them a tall tower creeps from iteration to iteration.
bool ComingToRest::is_driven_by_loads() const {
  const VecX f = applied_forces(model_, start_, start_.time + options_.time_advance);
  const double violation = trial_.residuals.rigid_contact_speed * trial_.h * acceleration_;
  return f.dot(trial_.step_solution.v) >
         violation * normal_force_sum(step_.problem, trial_.step_solution.gamma);
}

/// An iterate that is far from rest may come to rest with the next one, but the conic solver mostly decides in
/// less time whether it can.
bool ComingToRest::may_be_moving(double contraction) const {
  constexpr double kFarFromRest = 0.1;  // of the weight of a block; few structures that stand leave so much
  // Each goes farther: joints that slow it down would have done so. A step of an arch goes on for 40.
  constexpr int kBeyond = 5;
  if (options_.control) return num_beyond_ >= kBeyond;
  const bool not_asked = !motion_proof_ && options_.solve.law.is_associated();
  return (not_asked && residual_ > kFarFromRest) || ProximalPoint::may_be_moving(contraction);
}

/// A motion is proven under the associated law only.
std::optional<StaticSolution> ComingToRest::judge_motion(double contraction) {
  constexpr int kMoving = 3, kUnproven = 15;  // steady iterations until the search ends
  if (options_.control) return give_up(num_beyond_);
  if (!options_.solve.law.is_associated())
    return moves_steadily(contraction, kMoving) && is_driven_by_loads() ? std::optional(finish_moving(""))
                                                                        : std::nullopt;
  if (is_proven_to_move()) {
    StaticSolution answer = finish(
        StaticOutcome::moving,
        fmt::format(
            "no equilibrium exists: {}; a mechanism that the loads drive and no joint resists proves it",
            acceleration_text()));
    answer.proven = true;
    return answer;
  }
  const double required = required_forces();
  if (required >= kFarFromEquilibrium && motion_proof_->search() != MotionProof::Answer::admissible) {
    StaticSolution answer =
        finish(StaticOutcome::moving,
               fmt::format("no equilibrium was found: {}; {}", acceleration_text(), unproven_text(required)));
    answer.forces_over_loads = required;
    return answer;
  }
  if (!moves_steadily(contraction, kUnproven)) return {};
  return finish(
      StaticOutcome::unconverged,
      fmt::format("{} in {}, but contact forces {:.2g} times as large as the loads might balance them",
                  acceleration_text(), counted(kUnproven, "iteration"), required));
}

}  // namespace cupola
