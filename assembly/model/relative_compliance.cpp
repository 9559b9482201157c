#include "assembly/model/relative_compliance.hpp"

namespace cupola {

void resolve_compliance(const Assembly& assembly, const Vec3& gravity, Compliance* compliance) {
  if (!compliance->relative) return;
  double mass = 0.0, volume = 0.0;
  for (const Block& block : assembly.blocks) {
    if (block.fixed) continue;
    mass += block.mass;
    volume += block.volume;
  }
  constexpr double kEarth = 9.81;  // m/s2
  const double acceleration = gravity.norm() > 0.0 ? gravity.norm() : kEarth;
  // Without free blocks nothing closes.
  compliance->normal = volume > 0.0 ? *compliance->relative * volume / (mass * acceleration) : 0.0;
  compliance->tangential = Compliance::kTangential * compliance->normal;
}

}  // namespace cupola
