#include "assembly/model/sheet.hpp"

namespace cupola {

std::optional<Eigen::Vector3d> Sheet::outward(const Eigen::Vector3d& point) const {
  using Eigen::Vector3d;
  switch (thrust_lines) {
    case ThrustLines::by_azimuth:
      return Vector3d(point.x(), point.y(), 0.0).stableNormalized();
    case ThrustLines::one:
      return Vector3d(point.x() < 0.0 ? -1.0 : 1.0, 0.0, 0.0);
    case ThrustLines::none:
      break;
  }
  return std::nullopt;
}

}  // namespace cupola
