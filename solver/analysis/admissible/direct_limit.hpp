#pragma once

#include <functional>
#include <optional>
#include <string>

#include "assembly/case/case.hpp"
#include "assembly/model/results.hpp"
#include "solver/analysis/admissible/rigid_scene.hpp"
#include "solver/conic/conic_bounds.hpp"

namespace cupola {

/// One solve of a direct limit analysis.
struct DirectTrial {
  double value = 0.0;
  std::optional<bool> admissible;  ///< forces in equilibrium and within the cones exist; none: undecided
  std::optional<double>
      pull;  ///< that the contacts need (pull_solve.hpp); infinite: none helps, or any pressure is possible
  int iterations = 0;
};

/// The critical value between a value with an admissible state and one for which a mechanism proves that
/// there is none. If none was found, the state or the mechanism of one end of a search both of whose ends have
/// it; neither if the search shows nothing.
struct DirectLimit {
  bool found = false;                       ///< the bracket of the critical value
  std::optional<bool> stands_at_both_ends;  ///< not found: what it does at both ends of the search, if alike
  double admissible = 0.0, moving = 0.0;
  double span = 1.0;  ///< of the search, from one end to the other
  /// Just beyond `moving` the mechanism proves in exact arithmetic that no forces balance the loads
  /// (motion_proof.hpp). Otherwise none do of up to `resisting_forces` times those found (conic_bounds.hpp).
  bool motion_proven = false;
  double resisting_forces = kLargestForces;
  RigidScene at_admissible, at_moving;
  VecX gamma;      ///< N: the admissible state (3 nc)
  VecX mechanism;  ///< its velocities prove the motion (6 nb); empty for a stress
  int trials = 0, iterations = 0;
  /// How the search ended: why it found nothing, or what its proof leaves open, and what else is known.
  Sought sought;
  double middle() const { return 0.5 * (admissible + moving); }
  /// The critical value is zero but for rounding, which has no relative width.
  bool is_zero() const;
  double relative_width() const;  ///< relative to the middle, of zero to the span
};

/// The scene at one value of the parameter.
using SceneAt = std::function<RigidScene(double value)>;
using ReportTrial = std::function<void(const DirectTrial&)>;

/// Critical value of a parameter on which the loads depend smoothly. Each iteration maximises (or minimises)
/// the multiplier t of the loads w(x) + t w'(x), linear in x, and moves x by t: one solve where the loads are
/// linear in the parameter, a few for a tilt, after halving the bracket where they have no such multiplier.
/// `low` and `high`: an admissible state exists at one of them. If one exists at both, and loads that are
/// linear and grow away from zero have one by themselves, there is no limit.
/// `in_unit`: from the values of the search to those of messages. `own`: the value of the case, within the
/// bracket, if larger loads are what it is to bear: where it needs some of them, the limit is the upper one.
DirectLimit limit_of_loads(
    const SceneAt& scene_at, double low, double high, double relative_width, const ReportTrial& report,
    const std::function<double(double)>& in_unit = [](double value) { return value; },
    std::optional<double> own = {});

/// Critical value of a parameter of the joints: the root of the pull alpha that the contacts need
/// (pull_solve.hpp). Friction and extent of the joints, on which the conditions depend linearly: Newton's
/// method with the derivative that the mechanism gives, on rough solves, until its next step would not leave
/// the width required; then a solve on either side of the root, or, where joints bear tension, of which more
/// friction leaves less, at both ends; friction counts from 1e-5, with cohesion 1e-3.
/// Thickness: the secant method. A bracket that always contains the root safeguards both.
DirectLimit limit_of_joints(const SceneAt& scene_at, double low, double high, double relative_width,
                            LimitSearch::Parameter parameter, const ReportTrial& report);

/// The least peak stress, Pa: the smallest p for which an admissible state exists whose normal forces are at
/// most p times the areas of their contact points,
///
///     minimise p,   D gamma + w = 0,   gamma in Y,   gamma_n,i <= p A_i
///
/// One conic programme. `moving`: no state has less. Requires compliance per area (InputError), with which
/// contact points stand for areas.
DirectLimit least_peak_stress(const Case& scene, RigidScene rigid, const ReportTrial& report);

/// The search ends without a limit: why. Keeps the counts of what was solved.
DirectLimit not_found(DirectLimit searched, Sought why);
/// Why: the solve at an end of the bracket did not decide, and what to try.
Sought unsolved_end(double value);

}  // namespace cupola
