#include <numbers>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

// Steps are counted in an int; a run of a month takes fewer than this.
constexpr double kMostSteps = 1e9;

void declare_thresholds(Section& s, Analysis::Thresholds& thresholds) {
  s.number(
      "speed", thresholds.speed, {.unit = "m/s", .above = 0},
      "a run with a point of a block faster relative to the ground within its last `window` has the status "
      "moving");
  s.number("window", thresholds.window, {.unit = "s", .min = 0},
           "a motion is at rest if all points are slower than `speed` for this long at its end, not less "
           "than this long after its start, and their mean velocity over this time is below a tenth of it");
  s.optional_number(
      "displacement", thresholds.displacement, {.unit = "m", .above = 0},
      "none: half the mean size (cube root of the volume) of the free blocks, at most 0.5 m",
      "a run with a point of a block displaced further, relative to the ground and without what the "
      "block follows of the move of a support, has the status collapsed");
}

void declare_adaptive(Section& s, AdaptiveStep& adaptive) {
  s.number("smallest", adaptive.smallest, {.unit = "s", .above = 0}, "shortest time step");
  s.number("largest", adaptive.largest, {.unit = "s", .above = 0}, "longest time step");
  s.rule(adaptive.smallest <= adaptive.largest, "largest", "must be >= smallest");
}

void declare_stop(Section& s, StopRules& stop) {
  s.flag("collapsed", stop.collapsed, "stop as soon as a block exceeds thresholds.displacement");
  s.number("settled_time", stop.settled_time, {.unit = "s", .min = 0},
           "stop once all blocks have been slower than 1e-5 m/s for this long, and loads, supports and "
           "friction no longer change; 0: never");
  s.retired("settled_speed",
            "remove it: analysis.stop.settled_time counts blocks slower than 1e-5 m/s as settled");
}

/// Of the forces, whatever state the compliances choose.
bool asks_for_admissible_states(LimitSearch::Parameter parameter) {
  return parameter == LimitSearch::Parameter::joint_extent ||
         parameter == LimitSearch::Parameter::peak_stress;
}

void declare_limit(Section& s, LimitSearch& limit) {
  using Parameter = LimitSearch::Parameter;
  s.choice(
      "parameter", limit.parameter,
      "parameter whose critical value is sought: friction coefficient; tilt of gravity (deg); horizontal "
      "acceleration (g); factor on loads.forces and loads.faces, but no fill (load); factor on the shell "
      "thickness about "
      "its middle surface; factor on supports.moves (spread; take Coulomb's law where joints slide: the "
      "associated law lifts what slides); factor on the extent of every joint about its "
      "centroid (direct only), whose inverse is the geometric safety of the safest state; weight of the "
      "lantern over that of the blocks; least peak stress of an admissible state (Pa, direct only, with "
      "compliance per area)");
  s.choice("method", limit.method,
           "direct: conic programmes over all admissible states (associated law, not for spread); bisection: "
           "one static solve per value; automatic: direct where it applies");
  const bool scales = limit.parameter == Parameter::thickness || limit.parameter == Parameter::joint_extent;
  if (scales) limit.low = 0.01;
  if (limit.parameter == Parameter::tilt) limit.high = 90.0;
  s.number("low", limit.low, {}, "lower end of the initial bracket; not used by peak_stress",
           "0; thickness, joint_extent: 0.01");
  s.number("high", limit.high, {}, "upper end of the initial bracket; not used by peak_stress",
           "1; tilt: 90");
  s.optional_number("relative_width", limit.relative_width, {.above = 0, .below = 1},
                    "1e-3 by bisection; direct: 1e-4 for friction, thickness and joint_extent, else 1e-5",
                    "largest width of the final bracket over its middle value");
  s.vector3("direction", limit.direction, {},
            "tilt, acceleration: horizontal direction of the pull; where gravity leans, its part at right "
            "angles to gravity");
  s.optional_section("joints", limit.joints, "friction: vary only these joints; default: all joints",
                     declare_joint_group);
  s.rule(!scales || limit.low > 0.0, "low", "must be > 0 when parameter is thickness or joint_extent");
  s.rule(limit.low < limit.high, "high", "must be > low");
  s.rule(limit.method != LimitSearch::Method::direct || limit.parameter != Parameter::spread, "method",
         "direct does not apply to spread, which follows displacements; use bisection");
  s.rule(limit.method != LimitSearch::Method::bisection || !asks_for_admissible_states(limit.parameter),
         "method",
         "bisection does not apply to joint_extent and peak_stress, which ask for admissible states; use "
         "direct");
}

void declare_control(Section& s, LoadPath::Control& control) {
  s.required_block("block", control.block, "number or name of a support that moves, or of a free block");
  s.optional_block("relative_to", control.relative_to, "none: the world",
                   "block from which its displacement counts, for example on the other side of a crack");
  s.vector3("direction", control.direction, {}, "direction of its displacement and force");
  s.rule(control.direction.norm() > 0.0, "direction", "must not be zero");
}

void declare_path(Section& s, LoadPath& path) {
  s.integer("steps", path.steps, {.min = 1, .max = 1000000}, "number of equilibria after that at the time 0");
  s.number(
      "end", path.end, {.unit = "s", .above = 0},
      "time of the last equilibrium, to which loads, friction and supports follow their functions of time");
  s.optional_number(
      "length", path.length, {.unit = "m", .above = 0}, "none: equal steps of time",
      "displacement of the control up to which the path is followed in equal steps; the time of each "
      "equilibrium is then found between 0 and end, and falls beyond a largest load");
  s.choice("geometry", path.geometry,
           "geometry in which each equilibrium holds: that at the start of its step unless it moves a block "
           "by more "
           "than a hundredth of the smallest, or always that at its end, found by further solves");
  s.rule(path.geometry == PathGeometry::start || !path.length, "geometry",
         "end excludes length: give one of the two");
  s.optional_section("control", path.control,
                     "block whose displacement and force path.csv tabulates; none: the support that moves "
                     "farthest or else the block whose load changes most",
                     declare_control);
}

void declare_sleep(Section& s, Sleep& sleep) {
  s.number("speed", sleep.speed, {.unit = "m/s", .above = 0}, "a block slower than this counts as at rest");
  s.number("time", sleep.time, {.unit = "s", .above = 0},
           "an island of touching blocks sleeps after this long at rest");
}

void declare_wrench_error(Section& s, RequestedAccuracy& accuracy) {
  s.optional_number(
      "wrench_error", accuracy.wrench_error, {.above = 0, .max = 0.5}, "none",
      "static: relative error of the bed-joint wrenches to certify; the solver chooses the tolerance");
}

/// Case files name the ends of the range or give the ratio, not both.
void declare_flow_rule(Section& s, Analysis& analysis) {
  s.optional_number("dilatancy", analysis.dilatancy, {.min = 0, .max = 1}, "as friction_law",
                    "opening of sliding joints over mu times their slip; 0: coulomb, 1: associated");
  if (analysis.dilatancy) {
    s.rule(!s.gives("friction_law"), "dilatancy",
           "must not be given together with friction_law, which names its ends");
    analysis.friction_law = *analysis.dilatancy == 1.0   ? FrictionLaw::associated
                            : *analysis.dilatancy == 0.0 ? FrictionLaw::coulomb
                                                         : FrictionLaw::dilatant;
    return;
  }
  s.choice(
      "friction_law", analysis.friction_law, {FrictionLaw::associated, FrictionLaw::coulomb},
      "associated: sliding joints also open (dilate), a convex problem; coulomb: they slide without opening");
}

/// Tolerance of each preset: points on the measured curve of error against time.
double preset_tolerance(RequestedAccuracy::Preset preset, AnalysisType type) {
  const bool moves = type == AnalysisType::dynamic;
  switch (preset) {
    case RequestedAccuracy::Preset::draft:
      return moves ? 1e-3 : 1e-2;
    case RequestedAccuracy::Preset::standard:
      return 1e-5;
    case RequestedAccuracy::Preset::reference:
      return 1e-10;
    case RequestedAccuracy::Preset::custom:
      break;
  }
  return 0.0;
}

/// A preset overrides the key `tolerance`, so that `--set analysis.accuracy=draft` works on any case.
void declare_accuracy(Section& s, Analysis& analysis) {
  using enum RequestedAccuracy::Preset;
  const NumberRule rule{.above = 0, .max = 0.1};
  s.choice_or_section("accuracy", analysis.accuracy.preset, analysis.accuracy,
                      "accuracy of the answer; every preset but custom sets the tolerance",
                      declare_wrench_error);
  if (analysis.accuracy.preset == custom) {
    // Of stages it is what a verdict requires; in motions the time step decides on the error.
    constexpr double kOfManySolves = 1e-5;
    const bool many = analysis.type == AnalysisType::staged || analysis.type == AnalysisType::dynamic;
    if (many && !s.gives("tolerance")) analysis.tolerance = kOfManySolves;
    s.number("tolerance", analysis.tolerance, rule,
             "static: largest equilibrium residual accepted; staged: the same, 1e-5 if not given; dynamic: "
             "largest relative momentum residual of a step, 1e-5 if not given");
  } else {
    analysis.tolerance = preset_tolerance(analysis.accuracy.preset, analysis.type);
    s.settled_number("tolerance", analysis.tolerance, rule);
  }
}

void expect_bracket(const Section& s, const LimitSearch& limit) {
  if (limit.parameter == LimitSearch::Parameter::tilt)
    s.expect({"limit.high", limit.high, "deg", std::numbers::pi / 2, 90.0, "in radians? A tilt is in degrees",
              "a wall that leans by more than 90 deg lies"});
  if (limit.parameter == LimitSearch::Parameter::acceleration)
    s.expect({"limit.high", limit.high, "g", 0.0, 5.0, "",
              "in m/s2? The horizontal acceleration is a multiple of g"});
}

}  // namespace

void declare_analysis(Section& s, Analysis& analysis) {
  s.choice(
      "type", analysis.type,
      "static equilibrium; motion in time; construction by courses or blocks; search for a critical "
      "parameter value; "
      "ranges of forces over all admissible states; equilibria along a path of loads or support motions");
  s.choice("method", analysis.method, "numerical method for the contact problem");
  declare_flow_rule(s, analysis);
  s.integer("cyclic_sectors", analysis.cyclic_sectors, {.min = 1, .max = 100000},
            "static, range: number of equal sectors around the z axis, of which one is solved (a range: for "
            "quantities that repeat around the axis too); 1: solve the whole model");
  s.integer("robustness", analysis.robustness, {.min = 0, .max = 3600},
            "static: horizontal directions in which to find the least acceleration, at right angles to "
            "gravity, that "
            "makes it move; 0: none");
  declare_accuracy(s, analysis);
  s.integer("max_iterations", analysis.max_iterations, {.min = 0, .max = 1000000},
            "iterations of the method per contact problem; 0: the method's own limit");
  s.choice("integrator", analysis.integrator,
           "dynamic: implicit Euler, first order, or the generalized alpha method, second order while "
           "contacts stay closed");
  s.rule(analysis.integrator == TimeIntegrator::euler || analysis.type == AnalysisType::dynamic, "integrator",
         "generalized_alpha applies to dynamic analyses only");
  s.number("time_step", analysis.time_step, {.unit = "s", .above = 0}, "dynamic: time step h");
  if (analysis.type == AnalysisType::dynamic)
    s.expect({"time_step", analysis.time_step, "s", 1e-7, 0.5, "too many zeros? Steps are in s",
              "in ms? Steps are in s"});
  s.optional_number(
      "time_error", analysis.time_error, {.unit = "m", .above = 0}, "none: fixed steps",
      "dynamic: adapt the time step, starting from time_step, so that the estimated error of a "
      "displacement in one step stays below this; steps that exceed it four times are repeated");
  s.optional_section("adaptive", analysis.adaptive, "dynamic: bounds of the steps that time_error chooses",
                     declare_adaptive);
  s.rule(!analysis.adaptive || analysis.time_error, "adaptive",
         "requires time_error, the error accepted per step");
  if (analysis.time_error) {
    if (!analysis.adaptive) analysis.adaptive.emplace();
    analysis.adaptive->displacement_error = *analysis.time_error;
  }
  s.number("duration", analysis.duration, {.unit = "s", .above = 0},
           "dynamic: simulated time; the last fixed step covers its end",
           "4 s after the last change of loads, supports and friction, or the first period of a wave");
  s.number("damping", analysis.damping, {.unit = "s", .min = 0},
           "damping coefficient over stiffness of contacts and ties, alpha");
  s.number("recovery_speed", analysis.recovery_speed, {.unit = "m/s", .above = 0},
           "largest speed at which penetration beyond that due to compliance is corrected");
  s.choice("recovery", analysis.recovery,
           "dynamic: what recovery_speed limits: penetration beyond that due to compliance, or all of it, "
           "the paper's scheme (eq. 14), in which contacts loaded by more than recovery_speed h / compliance "
           "sink without end");
  s.rule(analysis.recovery == Recovery::compliant || analysis.type == AnalysisType::dynamic, "recovery",
         "literal applies to dynamic analyses only; equilibria have no time in which to recover");
  s.rule(analysis.recovery == Recovery::compliant || analysis.integrator == TimeIntegrator::euler, "recovery",
         "literal is a scheme of implicit Euler; use integrator: euler");
  s.choice("tangential", analysis.tangential,
           "dynamic: tangential spring with memory of its slip, or the paper's scheme, which creeps");
  s.rule(analysis.integrator == TimeIntegrator::euler || analysis.tangential == TangentialSpring::memory,
         "tangential", "literal is a scheme of implicit Euler; use integrator: euler");
  s.section("thresholds", analysis.thresholds, "limits that decide the status", declare_thresholds);
  s.choice("start", analysis.start,
           "dynamic: start unloaded (rest) or in static equilibrium; automatic: static under base motion or "
           "varying friction, else rest");
  s.section("stop", analysis.stop, "dynamic: conditions that end the run before its duration", declare_stop);
  s.rule(analysis.stop.settled_time == 0.0 || analysis.stop.settled_time >= analysis.thresholds.window,
         "stop.settled_time",
         fmt::format("{} s: must be 0 or >= thresholds.window, {} s, over which rest is judged",
                     analysis.stop.settled_time, analysis.thresholds.window));
  s.section("limit", analysis.limit, "limit: parameter and bracket of the search", declare_limit);
  if (analysis.type == AnalysisType::limit) expect_bracket(s, analysis.limit);
  s.section("range", analysis.range, "range: quantities sought over all admissible states", declare_range);
  s.section("staged", analysis.staged, "staged: order of the stages, and the fresh mortar", declare_staged);
  s.rule(
      analysis.type != AnalysisType::staged || analysis.staged.unit == StagedConstruction::Unit::ring ||
          analysis.staged.allow_associated || analysis.friction_law == FrictionLaw::coulomb,
      "staged.unit",
      "block requires friction_law: coulomb. Under the other laws a joint that slides opens, which jams an "
      "open course between uprights at any friction; staged.allow_associated: true admits them");
  s.section("path", analysis.path, "path: steps, and the block to tabulate", declare_path);
  s.rule(analysis.type != AnalysisType::range || !analysis.range.quantities.empty(), "range",
         "must list at least one quantity: {quantities: [thrust]}");
  s.rule(analysis.type == AnalysisType::static_ || analysis.type == AnalysisType::range ||
             analysis.cyclic_sectors == 1,
         "cyclic_sectors", "values above 1 require analysis.type: static or range");
  s.rule(analysis.type == AnalysisType::static_ || analysis.robustness == 0, "robustness",
         "requires analysis.type: static; the limit analysis of an acceleration takes one direction");
  s.flag("plane", analysis.plane,
         "restrict motion to the x-z plane, with three unknowns per block; the model must be plane (walls, "
         "arches)");
  s.optional_section("sleep", analysis.sleep,
                     "dynamic: leave islands of blocks at rest out of the contact problem", declare_sleep);
  s.rule(!analysis.sleep || (analysis.type == AnalysisType::dynamic && !analysis.adaptive), "sleep",
         "requires type: dynamic without adaptive");
  s.rule(analysis.limit.method != LimitSearch::Method::direct ||
             analysis.friction_law == FrictionLaw::associated,
         "limit.method", "direct requires friction_law: associated; use bisection under Coulomb's law");
  s.rule(!asks_for_admissible_states(analysis.limit.parameter) ||
             analysis.friction_law == FrictionLaw::associated,
         "limit.parameter", "joint_extent and peak_stress require friction_law: associated");
  s.rule(!analysis.accuracy.wrench_error || analysis.type == AnalysisType::static_, "accuracy",
         "wrench_error is for static analysis only; for other types give a tolerance or a preset");
  s.rule(analysis.type != AnalysisType::dynamic || analysis.duration / analysis.time_step <= kMostSteps,
         "duration", "duration / time_step must be <= 1e9 steps; lengthen time_step or shorten duration");
}

}  // namespace cupola
