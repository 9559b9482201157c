#include "assembly/model/sheet.hpp"

#include <Eigen/Geometry>

#include "assembly/model/outward.hpp"

namespace cupola {

std::optional<Eigen::Vector3d> Sheet::outward(const Eigen::Vector3d& point) const {
  if (thrust_lines == ThrustLines::none) return std::nullopt;
  const bool arch = thrust_lines == ThrustLines::one;
  if (is_central()) return outward_at(point, arch);
  const Eigen::AngleAxisd own(turn, Eigen::Vector3d::UnitZ());
  return own * outward_at(own.inverse() * (point - origin), arch);
}

}  // namespace cupola
