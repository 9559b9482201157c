#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A system of forces reduced to a point: resultant and moment about the point, in world axes.
struct Wrench {
  Vec3 point = Vec3::Zero();   ///< m
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N m, about `point`

  void add_force(const Vec3& at, const Vec3& f);
  void add(const Wrench& other);  ///< reduces the other wrench to this point first
};

Wrench operator*(double factor, const Wrench& wrench);

/// The same system of forces reduced to another point.
Wrench moved_to(const Wrench& wrench, const Vec3& point);

/// Central axis of a wrench (Poinsot; paper, section 3.2): the line of action on which the moment is parallel
/// to the force.
///
///     point  = p + (F x M) / |F|^2        p: the wrench's own point
///     couple = (M.F) / |F|^2  F
struct CentralAxis {
  bool exists = false;         ///< false if the force is zero
  Vec3 point = Vec3::Zero();   ///< m, point of the line nearest to the wrench's point
  Vec3 couple = Vec3::Zero();  ///< N m, parallel to the force
  double couple_length = 0.0;  ///< m, |couple| / |force|
};
CentralAxis central_axis(const Wrench& wrench);

/// Intersection of the central axis with a plane; the point of the axis if the axis runs along the plane.
Vec3 axis_in_plane(const CentralAxis& axis, const Vec3& force, const Plane& plane);

}  // namespace cupola
