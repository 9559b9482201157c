#include "assembly/model/sheet.hpp"

#include "assembly/model/outward.hpp"

namespace cupola {

std::optional<Eigen::Vector3d> Sheet::outward(const Eigen::Vector3d& point) const {
  switch (thrust_lines) {
    case ThrustLines::by_azimuth:
      return outward_at(point, false);
    case ThrustLines::one:
      return outward_at(point, true);
    case ThrustLines::none:
      break;
  }
  return std::nullopt;
}

}  // namespace cupola
