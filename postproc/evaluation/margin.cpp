#include "postproc/evaluation/margin.hpp"

#include "assembly/case/limit_parameter.hpp"

namespace cupola {

std::optional<double> value_of_case(const Case& scene, const std::string& parameter) {
  if (parameter.starts_with("fresh ")) {
    const StagedConstruction& staged = scene.analysis.staged;
    if (!staged.curing.empty()) return std::nullopt;  // differs with the age
    return parameter == "fresh friction" ? staged.fresh.friction : staged.fresh.cohesion;
  }
  return parameter == to_string(scene.analysis.limit.parameter) ? own_value(scene) : std::nullopt;
}

std::optional<double> factor_of_safety(const Case& scene, const Summary& summary) {
  if (!summary.critical || summary.status == Status::unconverged) return std::nullopt;
  const CriticalValue& critical = *summary.critical;
  const std::optional<double> own = value_of_case(scene, critical.parameter);
  if (!own || !(*own * critical.stable > 0.0)) return std::nullopt;  // zero, or of other signs
  return critical.stable < critical.moving ? critical.stable / *own : *own / critical.stable;
}

}  // namespace cupola
