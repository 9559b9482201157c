#include "postproc/evaluation/margin.hpp"

namespace cupola {

std::optional<double> value_of_case(const Case& scene) {
  using Parameter = LimitSearch::Parameter;
  const LimitSearch& limit = scene.analysis.limit;
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
  const std::optional<double> own = value_of_case(scene);
  if (!own || *own == 0.0 || critical.stable == 0.0) return std::nullopt;
  return critical.stable < critical.moving ? critical.stable / *own : *own / critical.stable;
}

}  // namespace cupola
