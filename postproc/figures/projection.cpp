#include "postproc/figures/projection.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace cupola {

Projection projection_of(const Evaluation& e) {
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  if (!sheets.empty() && sheets.back().thrust_lines != Sheet::ThrustLines::by_azimuth)
    return {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
  const double a = -60.0 / kDegrees, slant = 30.0 / kDegrees;  // seen from azimuth a and from above
  const Vec3 right(-std::sin(a), std::cos(a), 0.0);
  const Vec3 up(-std::sin(slant) * std::cos(a), -std::sin(slant) * std::sin(a), std::cos(slant));
  return {right, up, right.cross(up)};
}

}  // namespace cupola
