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

}  // namespace

void declare_analysis(Section& s, Analysis& analysis) {
  s.choice("type", analysis.type, {{"static", AnalysisType::static_}, {"dynamic", AnalysisType::dynamic}},
           "equilibrium, or motion in time", {.later = {"staged", "limit"}});
  s.choice("method", analysis.method,
           {{"newton", ContactMethod::newton},
            {"interior_point", ContactMethod::interior_point},
            {"spg", ContactMethod::spg},
            {"apgd", ContactMethod::apgd},
            {"nsgs", ContactMethod::nsgs},
            {"admm", ContactMethod::admm}},
           "solver of the contact problem");
  s.choice("friction_law", analysis.friction_law,
           {{"associated", FrictionLaw::associated}, {"coulomb", FrictionLaw::coulomb}},
           "associated: sliding dilates (convex problem); coulomb: it does not");
  s.number("tolerance", analysis.tolerance, {.above = 0, .max = 0.1},
           "static: largest equilibrium residual; dynamic: relative momentum residual of a step");
  s.number("time_step", analysis.time_step, {.unit = "s", .above = 0}, "dynamic: step h");
  s.optional_section("adaptive", analysis.adaptive,
                     "dynamic: the step follows the motion, beginning at time_step", declare_adaptive);
  s.number("duration", analysis.duration, {.unit = "s", .above = 0}, "dynamic: simulated time");
  s.number("damping", analysis.damping, {.unit = "s", .min = 0}, "contact damping over stiffness, alpha");
  s.number("recovery_speed", analysis.recovery_speed, {.unit = "m/s", .above = 0},
           "fastest recovery of penetration that no compliance explains");
  s.choice("tangential", analysis.tangential,
           {{"memory", TangentialSpring::memory}, {"literal", TangentialSpring::literal}},
           "dynamic: spring that remembers its slip, or the paper's scheme that creeps");
  s.section("thresholds", analysis.thresholds, "limits that name the status", declare_thresholds);
  s.choice("start", analysis.start,
           {{"automatic", Analysis::Start::automatic},
            {"rest", Analysis::Start::rest},
            {"static", Analysis::Start::static_}},
           "dynamic: unloaded, or in equilibrium; automatic: static under base motion or varying friction");
  s.section("stop", analysis.stop, "dynamic: when to end before the duration", declare_stop);
  s.later({"accuracy"});
  s.rule(analysis.type != AnalysisType::dynamic || analysis.duration / analysis.time_step <= kMostSteps,
         "duration", "duration / time_step must be <= 1e9 steps");
}

}  // namespace cupola
