#include "postproc/mechanics/wrench.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace cupola {

void Wrench::add_force(const Vec3& at, const Vec3& f) {
  force += f;
  moment += (at - point).cross(f);
}

void Wrench::add(const Wrench& other) {
  force += other.force;
  moment += other.moment + (other.point - point).cross(other.force);
}

Wrench operator*(double factor, const Wrench& wrench) {
  return {wrench.point, factor * wrench.force, factor * wrench.moment};
}

Wrench moved_to(const Wrench& wrench, const Vec3& point) {
  return {point, wrench.force, wrench.moment + (wrench.point - point).cross(wrench.force)};
}

CentralAxis central_axis(const Wrench& wrench) {
  CentralAxis axis;
  const double squared = wrench.force.squaredNorm();
  axis.exists = squared > 0.0;
  axis.point = wrench.point;
  if (!axis.exists) return axis;
  axis.point += wrench.force.cross(wrench.moment) / squared;
  axis.couple = wrench.moment.dot(wrench.force) / squared * wrench.force;
  axis.couple_length = std::abs(wrench.moment.dot(wrench.force)) / squared;
  return axis;
}

Vec3 axis_in_plane(const CentralAxis& axis, const Vec3& force, const Plane& plane) {
  constexpr double kAlong = 1e-6;  // sine of the angle to the plane below which the axis counts as parallel
  const double across = plane.normal.dot(force);
  if (!axis.exists || std::abs(across) <= kAlong * force.norm()) return axis.point;
  return axis.point + (plane.offset - plane.normal.dot(axis.point)) / across * force;
}

}  // namespace cupola
