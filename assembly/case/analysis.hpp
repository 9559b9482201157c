#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "assembly/model/choices.hpp"
#include "assembly/model/force_quantity.hpp"
#include "assembly/model/joint_laws.hpp"

namespace cupola {

/// Time step adapted to the motion: the longest whose estimated error of a displacement stays below a bound.
struct AdaptiveStep {
  double smallest = 1e-5;            ///< s, > 0
  double largest = 0.05;             ///< s, >= smallest
  double displacement_error = 1e-4;  ///< m per step, > 0: Analysis::time_error
};

/// Conditions that end a dynamic analysis before its duration.
struct StopRules {
  bool collapsed = false;     ///< as soon as a block exceeds thresholds.displacement
  double settled_time = 0.0;  ///< s for which all blocks stay below kSettledSpeed; 0: never
  static constexpr double kSettledSpeed = 1e-5;  ///< m/s, a millimetre in 100 s
};

/// Search for the parameter value at which the structure ceases to stand.
struct LimitSearch {
  /// friction:     friction coefficient of the selected joints
  /// tilt:         angle of gravity from the vertical, deg
  /// acceleration: horizontal, over g
  /// load:         factor on `loads.forces` and `loads.faces`
  /// thickness:    factor on the thickness of the masonry, about its middle surface
  /// spread:       factor on `supports.moves`
  /// joint_extent: factor on the extent of every joint about its centroid; its inverse is the geometric
  /// safety of the
  ///               safest admissible state
  /// lantern:      weight of `loads.lantern` over that of the free blocks
  /// peak_stress: Pa, largest compressive stress of a contact point: the least one that an admissible state
  /// needs. `low`
  ///               and `high` are not used
  enum class Parameter {
    friction,
    tilt,
    acceleration,
    load,
    thickness,
    spread,
    joint_extent,
    lantern,
    peak_stress
  };
  Parameter parameter = Parameter::friction;
  /// direct:    conic programmes over all admissible states; associated law, not for `spread`
  /// bisection: one static solve for each value tried
  /// automatic: direct where it applies
  enum class Method { automatic, direct, bisection };
  Method method = Method::automatic;
  double low = 0.0, high = 1.0;  ///< initial bracket: stable at one end, not at the other
  /// Largest relative width of the final bracket, in (0, 1). None: 1e-3 by bisection; direct 1e-4 for
  /// friction, thickness and joint_extent, 1e-5 for the others, which are one conic programme.
  std::optional<double> relative_width;
  Eigen::Vector3d direction{1.0, 0.0, 0.0};  ///< tilt and acceleration: horizontal direction of the pull
  std::optional<RingJoints> joints;          ///< friction: only these joints; none: all joints
};
constexpr auto enum_names(LimitSearch::Method) {
  return std::array{"automatic", "direct", "bisection"};
}
constexpr auto enum_names(LimitSearch::Parameter) {
  return std::array{"friction", "tilt",         "acceleration", "load",       "thickness",
                    "spread",   "joint_extent", "lantern",      "peak_stress"};
}

/// Ranges of forces over all admissible states: forces that balance the loads within the joint laws.
struct RangeSearch {
  std::vector<ForceQuantity> quantities;
  bool states = false;  ///< write a frame for each end
};

/// Mortar of the joints that were laid last.
struct FreshMortar {
  int courses = 1;        ///< >= 1: courses laid last whose beds are fresh
  bool heads = false;     ///< their head joints are fresh too
  double friction = 0.1;  ///< mu, >= 0
  double cohesion = 0.0;  ///< Pa, >= 0
  double tension = 0.0;   ///< Pa, >= 0
  std::optional<double> normal,
      tangential;  ///< compliance, in the unit of Joints::compliance; none: hardened
  JointLawChange law() const { return {friction, normal, tangential, tension, cohesion, {}, {}}; }
};

/// Mortar of a given age, instead of FreshMortar. Properties between two rows are interpolated linearly.
struct CuringMortar {
  double age = 0.0;  ///< courses laid since, or days; >= 0
  JointLawChange law;
};

/// Construction course by course or block by block.
struct StagedConstruction {
  enum class Unit { ring, block };
  enum class Order { counterclockwise, clockwise, alternating, given };
  enum class Least { none, friction, cohesion };
  Unit unit = Unit::ring;                 ///< what each stage lays; by block: one of every team
  int teams = 1;                          ///< >= 1: equal arcs of a course that are laid at the same time
  Order order = Order::counterclockwise;  ///< seen from above, along the course
  std::vector<BlockRef> sequence;         ///< order `given`; the other blocks of a course follow
  bool carry = false;  ///< stages start from the state of the last one instead of unloaded joints
  int first_ring = 0;  ///< index of the last ring laid in the first stage
  int last_ring = -1;  ///< index of the last ring laid in the last stage; -1: the complete model
  FreshMortar fresh;
  std::vector<CuringMortar> curing;       ///< in the order of age; replaces the values of `fresh`
  std::optional<double> days_per_course;  ///< ages are in days; none: in courses
  int hold_below =
      -1;  ///< courses below the one laid that are solved, lower ones are supports; -1: all are solved
  bool allow_associated = false;  ///< accept a dilatant friction law for open courses
  Least least = Least::none;      ///< property of the fresh mortar whose least value is found for every stage
  double relative_width = 1e-2;   ///< relative width of its bracket, in (0, 1)
};
constexpr auto enum_names(StagedConstruction::Unit) {
  return std::array{"ring", "block"};
}
constexpr auto enum_names(StagedConstruction::Order) {
  return std::array{"counterclockwise", "clockwise", "alternating", "given"};
}
constexpr auto enum_names(StagedConstruction::Least) {
  return std::array{"none", "friction", "cohesion"};
}

/// Geometry in which each equilibrium of a path holds: that at the start of its step, or that which it leads
/// to.
enum class PathGeometry { start, end };
constexpr auto enum_names(PathGeometry) {
  return std::array{"start", "end"};
}

/// Sequence of equilibria from the assembly as built, at the times end / steps, 2 end / steps, ..., end.
/// Loads, friction and supports follow their functions of time; joints keep their slip, opening and damage
/// from one equilibrium to the next. With a length the control displacement grows by equal steps instead, and
/// the times are unknown.
struct LoadPath {
  int steps = 100;               ///< > 0
  double end = 1.0;              ///< s, > 0; with a length: the latest time
  std::optional<double> length;  ///< m, > 0: control displacement at the end of the path, from that at time 0
  PathGeometry geometry = PathGeometry::start;
  /// What path.csv tabulates.
  struct Control {
    BlockRef block;                            ///< a support that moves, or a free block
    std::optional<BlockRef> relative_to;       ///< block from which the displacement counts; none: the world
    Eigen::Vector3d direction{1.0, 0.0, 0.0};  ///< of its displacement and force; of any length > 0
  };
  std::optional<Control> control;  ///< none: chosen by what moves or loads most (path_control.hpp)
};

/// Accuracy requested by name, or as an error of the joint wrenches, instead of a tolerance.
struct RequestedAccuracy {
  /// Points on the measured curve of error against time (docs/data/accuracy.md). `custom` uses the key
  /// `tolerance`.
  enum class Preset { custom, draft, standard, reference };
  Preset preset = Preset::custom;
  /// Static analysis: rms relative error of the bed-joint wrenches to certify, in (0, 0.5].
  std::optional<double> wrench_error;
};
constexpr auto enum_names(RequestedAccuracy::Preset) {
  return std::array{"custom", "draft", "standard", "reference"};
}

/// Islands of touching blocks at rest are left out of the contact problem until something pushes them.
struct Sleep {
  double speed = 1e-5;  ///< m/s, > 0: slower blocks are at rest
  double time = 0.5;    ///< s, > 0: an island sleeps after this long at rest
};

struct Analysis {
  AnalysisType type = AnalysisType::static_;
  ContactMethod method = ContactMethod::newton;
  FrictionLaw friction_law = FrictionLaw::associated;
  /// Opening over slip of sliding joints, as a ratio to the friction coefficient, in [0, 1]. Given only
  /// instead of friction_law, which then follows from it.
  std::optional<double> dilatancy;
  /// Static: number of equal sectors around the z axis, of which one is solved; 1: the whole model is solved.
  int cyclic_sectors = 1;
  /// Static: number of horizontal directions in which the least acceleration that makes the structure move is
  /// sought; 0: none.
  int robustness = 0;
  /// Static: largest equilibrium residual accepted, inertia share included; it determines h. Dynamic: largest
  /// relative momentum residual of a step.
  double tolerance = 1e-9;
  RequestedAccuracy accuracy;
  /// Motion in the x-z plane only, with three unknowns per block; the model must be plane (walls, arches).
  bool plane = false;
  /// Iterations of the contact method per solve; 0: the method's own limit. A solve that reaches the limit
  /// ends as unconverged.
  int max_iterations = 0;
  /// The same without its special value: none means the limit of the method.
  std::optional<int> iteration_limit() const {
    return max_iterations > 0 ? std::optional(max_iterations) : std::nullopt;
  }
  TimeIntegrator integrator = TimeIntegrator::euler;  ///< dynamic only
  double time_step = 0.01;                            ///< h, s, dynamic only
  std::optional<double> time_error;                   ///< m per step, > 0; none: every step lasts time_step
  std::optional<AdaptiveStep> adaptive;
  double duration = 4.0;  ///< s, dynamic only
  double damping = 0.0;   ///< alpha, s, >= 0: contact damping over contact stiffness
  /// eps_u, m/s, > 0: largest speed at which penetration beyond that due to compliance is corrected.
  double recovery_speed = 0.6;
  Recovery recovery = Recovery::compliant;
  TangentialSpring tangential = TangentialSpring::memory;
  /// Initial state of a dynamic analysis: unloaded, or in static equilibrium under the loads at time 0.
  enum class Start { automatic, rest, static_ };
  Start start = Start::automatic;  ///< static under base motion or varying friction, else rest
  struct Thresholds {
    double speed = 1e-3;  ///< m/s: a faster block within the window makes the status `moving`
    double window = 0.2;  ///< s at the end of a motion over which rest is judged
    /// m: a block displaced further makes the status `collapsed`; none: see resolve_thresholds()
    std::optional<double> displacement = {};
    static constexpr double kDisplacement = 0.5;  // m
    double collapse() const { return displacement.value_or(kDisplacement); }
  } thresholds;
  StopRules stop;
  std::optional<Sleep> sleep;  ///< dynamic; none: all islands are solved in every step
  LimitSearch limit;
  RangeSearch range;
  StagedConstruction staged;
  LoadPath path;
};
constexpr auto enum_names(Analysis::Start) {
  return std::array{"automatic", "rest", "static"};
}

}  // namespace cupola
