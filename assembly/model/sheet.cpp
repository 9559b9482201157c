#include "assembly/model/sheet.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "assembly/model/outward.hpp"

namespace cupola {

Eigen::Vector3d Sheet::own(const Eigen::Vector3d& point) const {
  if (is_central()) return point;  // to the bit
  const Eigen::Vector3d foot(origin.x(), origin.y(), 0.0);
  return Eigen::AngleAxisd(-turn, Eigen::Vector3d::UnitZ()) * (point - foot);
}

Eigen::Vector3d Sheet::towards(double azimuth) const {
  return {std::cos(azimuth + turn), std::sin(azimuth + turn), 0.0};
}

std::optional<Eigen::Vector3d> Sheet::outward(const Eigen::Vector3d& point) const {
  if (thrust_lines == ThrustLines::none) return std::nullopt;
  const bool arch = thrust_lines == ThrustLines::one;
  if (is_central()) return outward_at(point, arch);
  return Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * outward_at(own(point), arch);
}

}  // namespace cupola
