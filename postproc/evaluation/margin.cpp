#include "postproc/evaluation/margin.hpp"

namespace cupola {

std::optional<double> value_of_case(const Case& scene, const std::string& parameter) {
  using Parameter = LimitSearch::Parameter;
  const LimitSearch& limit = scene.analysis.limit;
  if (parameter.starts_with("fresh ")) {
    const StagedConstruction& staged = scene.analysis.staged;
    if (!staged.curing.empty()) return std::nullopt;  // differs with the age
    return parameter == "fresh friction" ? staged.fresh.friction : staged.fresh.cohesion;
  }
  if (parameter != to_string(limit.parameter)) return std::nullopt;
  switch (limit.parameter) {
    case Parameter::friction:
      return limit.joints ? std::nullopt : std::optional(scene.joints.friction);
    case Parameter::load:
    case Parameter::joint_extent:
      return 1.0;
    case Parameter::tilt:
    case Parameter::acceleration:
    case Parameter::spread:
      return 0.0;
    case Parameter::lantern:
      if (const auto& lantern = scene.loads.lantern; lantern && lantern->weight + lantern->mass > 0.0)
        return std::nullopt;  // the limit is a share of the weight
      return scene.loads.lantern ? scene.loads.lantern->weight_fraction : 0.0;
    case Parameter::thickness:
    case Parameter::peak_stress:
      break;
  }
  return std::nullopt;
}

std::optional<double> factor_of_safety(const Case& scene, const Summary& summary) {
  if (!summary.critical) return std::nullopt;
  const CriticalValue& critical = *summary.critical;
  const std::optional<double> own = value_of_case(scene, critical.parameter);
  if (!own || *own == 0.0 || critical.stable == 0.0) return std::nullopt;
  return critical.stable < critical.moving ? critical.stable / *own : *own / critical.stable;
}

}  // namespace cupola
