#pragma once

#include <span>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A system of forces reduced to a point: resultant and moment about that point, world axes.
struct Wrench {
  Vec3 point = Vec3::Zero();   ///< m
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N m, about `point`

  void add_force(const Vec3& at, const Vec3& f);
  void add(const Wrench& other);  ///< reduced to this point
};

Wrench operator*(double factor, const Wrench& wrench);

/// The same system of forces reduced to another point.
Wrench moved_to(const Wrench& wrench, const Vec3& point);

/// A wrench in Poinsot's form: the force along a line, and a couple whose moment is parallel to it
/// (paper 3.2).
struct CentralAxis {
  bool exists = false;         ///< no line of action where there is no force
  Vec3 point = Vec3::Zero();   ///< m, of the line, the nearest to the wrench's point
  Vec3 couple = Vec3::Zero();  ///< N m, parallel to the force
  double couple_length = 0.0;  ///< m, |couple| / |force|
};
CentralAxis central_axis(const Wrench& wrench);

/// Where the central axis crosses a plane; the point of the axis itself when it runs along the plane.
Vec3 axis_in_plane(const CentralAxis& axis, const Vec3& force, const Plane& plane);

}  // namespace cupola
