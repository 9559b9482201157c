#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

// Steps are counted in an int, and a run of a month makes fewer.
constexpr double kMostSteps = 1e9;

void declare_thresholds(Section& s, Analysis::Thresholds& thresholds) {
  s.number("speed", thresholds.speed, {.unit = "m/s", .above = 0}, "faster at the end: status moving");
  s.number("displacement", thresholds.displacement, {.unit = "m", .above = 0}, "further: status collapsed");
}

void declare_adaptive(Section& s, AdaptiveStep& adaptive) {
  s.number("smallest", adaptive.smallest, {.unit = "s", .above = 0}, "shortest step");
  s.number("largest", adaptive.largest, {.unit = "s", .above = 0}, "longest step");
  s.number("displacement_error", adaptive.displacement_error, {.unit = "m", .above = 0},
           "error of one step, h |change of velocity| / 2 of the fastest block");
  s.rule(adaptive.smallest <= adaptive.largest, "largest", "must be >= smallest");
}

void declare_stop(Section& s, StopRules& stop) {
  s.flag("collapsed", stop.collapsed, "as soon as thresholds.displacement is exceeded");
  s.number("settled_time", stop.settled_time, {.unit = "s", .min = 0},
           "once all blocks have been slower than settled_speed for so long; 0: never");
  s.number("settled_speed", stop.settled_speed, {.unit = "m/s", .above = 0}, "slower counts as settled");
}

void declare_limit(Section& s, LimitSearch& limit) {
  using Parameter = LimitSearch::Parameter;
  s.choice(
      "parameter", limit.parameter,
      "what is varied: a friction coefficient; tilt of gravity (deg); horizontal acceleration (g); factor on "
      "loads.forces and loads.faces; factor on the thickness about the middle surface; factor on "
      "supports.moves");
  s.number("low", limit.low, {}, "one end of the bracket");
  s.number("high", limit.high, {}, "other end");
  s.number("relative_width", limit.relative_width, {.above = 0, .below = 1}, "of the final bracket");
  s.vector3("direction", limit.direction, {}, "horizontal direction of tilt and acceleration");
  s.optional_section("joints", limit.joints, "whose friction is varied; left out: of all joints",
                     declare_joint_group);
  s.rule(limit.parameter != Parameter::thickness || limit.low > 0.0, "low", "must be > 0 for a thickness");
  s.rule(limit.low < limit.high, "high", "must be > low");
}

void declare_staged(Section& s, StagedConstruction& staged) {
  s.integer("first_ring", staged.first_ring, {.min = 0}, "last ring laid in the first stage");
  s.integer("last_ring", staged.last_ring, {.min = -1},
            "last ring laid in the last stage; -1: the complete model");
  s.number("fresh_friction", staged.fresh_friction, {.min = 0}, "of the bed of the ring just laid");
  s.flag("critical_friction", staged.critical_friction,
         "also search the fresh friction at which each stage falls");
  s.number("relative_width", staged.relative_width, {.above = 0, .below = 1}, "of that bracket");
}

void declare_sleep(Section& s, Sleep& sleep) {
  s.number("speed", sleep.speed, {.unit = "m/s", .above = 0}, "slower counts as rest");
  s.number("time", sleep.time, {.unit = "s", .above = 0}, "at rest for so long, an island sleeps");
}

void declare_wrench_error(Section& s, Accuracy& accuracy) {
  s.optional_number(
      "wrench_error", accuracy.wrench_error, {.above = 0, .max = 0.5}, "none",
      "static: relative error of the bed-joint wrenches to be certified; the tolerance follows");
}

/// Tolerances of the presets, static and dynamic: points on the measured curve of time against error.
double preset_tolerance(Accuracy::Preset preset, AnalysisType type) {
  const bool moves = type == AnalysisType::dynamic;
  switch (preset) {
    case Accuracy::Preset::draft:
      return moves ? 1e-3 : 1e-2;
    case Accuracy::Preset::standard:
      return 1e-5;
    case Accuracy::Preset::reference:
      return 1e-10;
    case Accuracy::Preset::custom:
      break;
  }
  return 0.0;
}

/// A preset settles the tolerance, so that `--set analysis.accuracy=draft` works on any case.
void declare_accuracy(Section& s, Analysis& analysis) {
  using enum Accuracy::Preset;
  const NumberRule rule{.above = 0, .max = 0.1};
  s.choice_or_section("accuracy", analysis.accuracy.preset, analysis.accuracy,
                      "how good the answer shall be; all but custom settle the tolerance",
                      declare_wrench_error);
  if (analysis.accuracy.preset == custom) {
    s.number("tolerance", analysis.tolerance, rule,
             "static: largest equilibrium residual; dynamic: relative momentum residual of a step");
  } else {
    analysis.tolerance = preset_tolerance(analysis.accuracy.preset, analysis.type);
    s.settled_number("tolerance", analysis.tolerance, rule);
  }
}

}  // namespace

void declare_analysis(Section& s, Analysis& analysis) {
  s.choice("type", analysis.type,
           "equilibrium; motion in time; construction ring by ring; search of a critical value");
  s.choice("method", analysis.method, "solver of the contact problem");
  s.choice("friction_law", analysis.friction_law,
           "associated: sliding dilates (convex problem); coulomb: it does not");
  s.integer("cyclic_sectors", analysis.cyclic_sectors, {.min = 1, .max = 100000},
            "static: so many equal sectors around the z axis, of which one is solved; 1: the whole model");
  declare_accuracy(s, analysis);
  s.integer("max_iterations", analysis.max_iterations, {.min = 0, .max = 1000000},
            "of the method per contact problem; 0: its own limit");
  s.number("time_step", analysis.time_step, {.unit = "s", .above = 0}, "dynamic: step h");
  s.optional_section("adaptive", analysis.adaptive,
                     "dynamic: the step follows the motion, beginning at time_step", declare_adaptive);
  s.number("duration", analysis.duration, {.unit = "s", .above = 0}, "dynamic: simulated time");
  s.number("damping", analysis.damping, {.unit = "s", .min = 0}, "contact damping over stiffness, alpha");
  s.number("recovery_speed", analysis.recovery_speed, {.unit = "m/s", .above = 0},
           "fastest recovery of penetration that no compliance explains");
  s.choice("tangential", analysis.tangential,
           "dynamic: spring that remembers its slip, or the paper's scheme that creeps");
  s.section("thresholds", analysis.thresholds, "limits that name the status", declare_thresholds);
  s.choice("start", analysis.start,
           "dynamic: unloaded, or in equilibrium; automatic: static under base motion or varying friction");
  s.section("stop", analysis.stop, "dynamic: when to end before the duration", declare_stop);
  s.section("limit", analysis.limit, "limit: what is searched", declare_limit);
  s.section("staged", analysis.staged, "staged: what is built", declare_staged);
  s.rule(analysis.type == AnalysisType::static_ || analysis.cyclic_sectors == 1, "cyclic_sectors",
         "needs analysis.type: static");
  s.flag("plane", analysis.plane,
         "motion in the plane x-z alone, three unknowns per block; the scene must be plane");
  s.optional_section("sleep", analysis.sleep, "dynamic: islands of blocks at rest leave the problem",
                     declare_sleep);
  s.rule(!analysis.sleep || (analysis.type == AnalysisType::dynamic && !analysis.adaptive), "sleep",
         "needs type dynamic with steps of one length");
  s.rule(!analysis.accuracy.wrench_error || analysis.type == AnalysisType::static_, "accuracy",
         "wrench_error serves a static analysis; in motion give a tolerance or a preset");
  s.rule(analysis.type != AnalysisType::dynamic || analysis.duration / analysis.time_step <= kMostSteps,
         "duration", "duration / time_step must be <= 1e9 steps");
}

}  // namespace cupola
