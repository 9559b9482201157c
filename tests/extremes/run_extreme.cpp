#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/collision/geometry_warnings.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "tests/extremes/extreme_scene.hpp"

namespace cupola {
namespace {

Ending ending_of(Status status) {
  switch (status) {
    case Status::stable:
      return Ending::stable;
    case Status::moving:
      return Ending::moving;
    case Status::collapsed:
      return Ending::collapsed;
    case Status::unconverged:
      break;
  }
  return Ending::missed;
}

bool finite(const std::vector<Vec3>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const Vec3& x) { return x.allFinite(); });
}

bool finite(const Frame& frame) {
  return finite(frame.contacts.point) && finite(frame.contacts.normal) && finite(frame.contacts.force) &&
         finite(frame.blocks.position) && finite(frame.blocks.velocity) && finite(frame.blocks.displacement);
}

bool finite(const Summary& s) {
  for (const auto& value : {s.equilibrium_residual, s.momentum_residual, s.contact_law_residual,
                            s.max_displacement_m, s.max_speed_m_per_s})
    if (value && !std::isfinite(*value)) return false;
  return std::isfinite(s.accuracy.reached + s.accuracy.worst_over_run + s.weight_N) &&
         s.support_reaction_N.allFinite() && s.applied_load_N.allFinite();
}

std::string fault_of(const ExtremeScene& scene, const ExtremeResult& result) {
  if (std::find(scene.endings.begin(), scene.endings.end(), result.ending) == scene.endings.end())
    return fmt::format("ended {}: {}", to_string(result.ending), result.message);
  const bool rounded = result.message.find("rounding of the velocities") != std::string::npos;
  if (result.ending == Ending::stable && !(result.reached <= result.asked) && !rounded)
    return fmt::format("reported as stable although the accuracy {:.2e} exceeds the requested {:.2e}",
                       result.reached, result.asked);
  return "";
}

}  // namespace

ExtremeResult run_extreme(const ExtremeScene& extreme) {
  ExtremeResult result;
  const double started = cpu_seconds();
  try {
    const Scene scene = extreme.make();
    geometry_warnings(scene.assembly, detection_options(scene.input));
    Frame last;
    AnalysisSinks sinks;
    sinks.frame = [&last](const Frame& frame) { last = frame; };
    const Summary summary = run_analysis(scene.input, scene.assembly, sinks).value();
    result.ending = ending_of(summary.status);
    result.message = summary.message;
    result.asked = summary.accuracy.asked;
    result.reached = summary.accuracy.worst_over_run;
    result.fault = fault_of(extreme, result);
    if (result.fault.empty() && !(finite(summary) && finite(last))) result.fault = "a number is not finite";
    if (result.fault.empty() && extreme.check && result.ending != Ending::missed)
      result.fault = extreme.check(summary, last);
  } catch (const InputError& error) {
    result.ending = Ending::refused;
    result.message = error.what();
    result.fault = fault_of(extreme, result);
  }
  result.seconds = cpu_seconds() - started;
  return result;
}

}  // namespace cupola
