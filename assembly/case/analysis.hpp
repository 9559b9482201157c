#pragma once

#include <optional>

#include <Eigen/Core>

#include "assembly/model/choices.hpp"
#include "assembly/model/joint_laws.hpp"

namespace cupola {

/// Time step that follows the motion. The error of implicit Euler in one step is taken as h |v_new - v|/2 of
/// the fastest block.
struct AdaptiveStep {
  double smallest = 1e-5;            ///< s, > 0
  double largest = 0.05;             ///< s, >= smallest
  double displacement_error = 1e-4;  ///< m per step, > 0
};

/// When a dynamic analysis ends before its duration.
struct StopRules {
  bool collapsed = false;       ///< as soon as thresholds.displacement is exceeded
  double settled_time = 0.0;    ///< s that all blocks stay below settled_speed; 0: never
  double settled_speed = 1e-5;  ///< m/s, > 0
};

/// Search of the value at which the structure ceases to stand.
struct LimitSearch {
  /// friction: the coefficient of the joints chosen; tilt: of gravity, deg; acceleration: horizontal, over
  /// g; load: factor on `loads.forces` and `loads.faces`; thickness: factor on that of the masonry, about
  /// its middle surface; spread: factor on `supports.moves`.
  enum class Parameter { friction, tilt, acceleration, load, thickness, spread };
  Parameter parameter = Parameter::friction;
  double low = 0.0, high = 1.0;              ///< bracket: stable at one end, not at the other
  double relative_width = 1e-3;              ///< of the final bracket, in (0, 1)
  Eigen::Vector3d direction{1.0, 0.0, 0.0};  ///< of tilt and acceleration, horizontal part of the pull
  std::optional<RingJoints> joints;          ///< friction: only these joints; none: all
};
constexpr auto enum_names(LimitSearch::Parameter) {
  return std::array{"friction", "tilt", "acceleration", "load", "thickness", "spread"};
}

/// Ring after ring is laid; the bed of the last ring has the friction of fresh mortar.
struct StagedConstruction {
  int first_ring = 0;             ///< first stage, index of the last ring laid
  int last_ring = -1;             ///< last stage; -1: the complete model
  double fresh_friction = 0.1;    ///< mu of the bed of the ring just laid, >= 0
  bool critical_friction = true;  ///< also search the fresh friction at which each stage falls
  double relative_width = 1e-2;   ///< of that bracket, in (0, 1)
};

/// How good the answer shall be, in words or as an error of the joints' wrenches, instead of a tolerance.
struct Accuracy {
  /// Points on the measured curve of time against error (README, "Speed against accuracy"): custom leaves the
  /// key `tolerance` as it is.
  enum class Preset { custom, draft, standard, reference };
  Preset preset = Preset::custom;
  /// Static analysis: relative error of the bed-joint wrenches, rms, to be certified; in (0, 1).
  std::optional<double> wrench_error;
};
constexpr auto enum_names(Accuracy::Preset) {
  return std::array{"custom", "draft", "standard", "reference"};
}

/// Islands of blocks that have come to rest leave the problem until something pushes them.
struct Sleep {
  double speed = 1e-5;  ///< m/s, > 0: slower is at rest
  double time = 0.5;    ///< s, > 0: at rest for so long, an island sleeps
};

struct Analysis {
  AnalysisType type = AnalysisType::static_;
  ContactMethod method = ContactMethod::newton;
  FrictionLaw friction_law = FrictionLaw::associated;
  /// Static: the model repeats so many times around the z axis, and one sector is solved for all; 1: none.
  int cyclic_sectors = 1;
  /// Static: largest equilibrium residual accepted, inertia share included; h follows from it. Dynamic: the
  /// relative momentum residual of each step.
  double tolerance = 1e-9;
  Accuracy accuracy;
  /// Motion in the plane x-z alone, three unknowns per block: the scene must be plane (walls).
  bool plane = false;
  /// Iterations of the contact method per solve; 0: the method's own limit. A budget that is used up ends as
  /// unconverged.
  int max_iterations = 0;
  /// The same without its special value: none means the limit of the method.
  std::optional<int> iteration_limit() const {
    return max_iterations > 0 ? std::optional(max_iterations) : std::nullopt;
  }
  double time_step = 0.01;  ///< h, s, dynamic only
  std::optional<AdaptiveStep> adaptive;
  double duration = 4.0;        ///< s, dynamic only
  double damping = 0.0;         ///< alpha, s: contact damping proportional to stiffness, >= 0
  double recovery_speed = 0.6;  ///< eps_u, m/s: fastest recovery of unexplained penetration, > 0
  TangentialSpring tangential = TangentialSpring::memory;
  /// How a dynamic analysis begins: unloaded, or in static equilibrium under the loads at time 0.
  enum class Start { automatic, rest, static_ };
  Start start = Start::automatic;  ///< static under base motion and falling friction, else rest
  struct Thresholds {
    double speed = 1e-3;        ///< m/s: faster is `moving`
    double displacement = 0.5;  ///< m: further is `collapsed`
  } thresholds;
  StopRules stop;
  std::optional<Sleep> sleep;  ///< dynamic; none: every island is solved in every step
  LimitSearch limit;
  StagedConstruction staged;
};
constexpr auto enum_names(Analysis::Start) {
  return std::array{"automatic", "rest", "static"};
}

}  // namespace cupola
