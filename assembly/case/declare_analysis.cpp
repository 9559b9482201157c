#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

// Steps are counted in an int, and a run of a month makes fewer.
constexpr double kMostSteps = 1e9;

void declare_thresholds(Section& s, Analysis::Thresholds& thresholds) {
  s.number("speed", thresholds.speed, {.unit = "m/s", .above = 0}, "faster at the end: status moving");
  s.number("displacement", thresholds.displacement, {.unit = "m", .above = 0}, "further: status collapsed");
}

}  // namespace

void declare_analysis(Section& s, Analysis& analysis) {
  s.choice("type", analysis.type, {{"static", AnalysisType::static_}, {"dynamic", AnalysisType::dynamic}},
           "equilibrium, or motion in time", {.later = {"staged", "limit"}});
  s.choice("method", analysis.method, {{"newton", ContactMethod::newton}}, "solver of the contact problem",
           {.later = {"spg", "apgd", "admm", "nsgs", "interior_point"}});
  s.choice("friction_law", analysis.friction_law, {{"associated", FrictionLaw::associated}},
           "associated: sliding dilates (convex problem)", {.later = {"coulomb"}});
  s.number("tolerance", analysis.tolerance, {.above = 0, .max = 0.1},
           "static: largest equilibrium residual; dynamic: relative momentum residual of a step");
  s.number("time_step", analysis.time_step, {.unit = "s", .above = 0}, "dynamic: step h");
  s.number("duration", analysis.duration, {.unit = "s", .above = 0}, "dynamic: simulated time");
  s.number("damping", analysis.damping, {.unit = "s", .min = 0}, "contact damping over stiffness, alpha");
  s.number("recovery_speed", analysis.recovery_speed, {.unit = "m/s", .above = 0},
           "fastest recovery of penetration that no compliance explains");
  s.choice("tangential", analysis.tangential,
           {{"memory", TangentialSpring::memory}, {"literal", TangentialSpring::literal}},
           "dynamic: spring that remembers its slip, or the paper's scheme that creeps");
  s.section("thresholds", analysis.thresholds, "limits that name the status", declare_thresholds);
  s.later({"accuracy", "start"});
  s.rule(analysis.type != AnalysisType::dynamic || analysis.duration / analysis.time_step <= kMostSteps,
         "duration", "duration / time_step must be <= 1e9 steps");
}

}  // namespace cupola
