#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace cupola {

/// What a member of the masonry is, for programs that must not know how it was drawn: a sheet of courses,
/// which lie on each other in the order of their numbers. The courses of several sheets have different
/// numbers. Sheets on each other are a stack.
struct Sheet {
  /// Where thrust lines are drawn: nowhere, in the x-z plane of an arch, or at any azimuth about the z axis.
  /// `radial`: nowhere, but outwards is away from the axis, as in a vault on several springers.
  enum class ThrustLines : std::uint8_t { none, one, by_azimuth, radial };

  std::string name;
  int first_ring = 0;   ///< number of its first course
  int num_rings = 0;    ///< courses of the complete model
  bool closed = false;  ///< the last block of a course meets the first
  ThrustLines thrust_lines = ThrustLines::none;
  int sails = 1;             ///< equal parts about its axis
  bool on_previous = false;  ///< its first bed lies on the last bed of the sheet before
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, a point of its vertical axis
  double turn = 0.0;  ///< rad, about that axis, from the x axis of the world to its own
  /// Of a wall or pier of several vaults: index of the sheet along whose outwards it pushes, by joints the
  /// nearest, one in its own stack before all. -1: see Assembly::vault_of.
  int vault = -1;

  bool has_ring(int ring) const { return ring >= first_ring && ring < first_ring + num_rings; }
  /// True if its axis is the z axis of the world.
  bool is_central() const { return origin.x() == 0.0 && origin.y() == 0.0 && turn == 0.0; }
  /// A point (m) in its own frame, to which heights do not belong: its axis is the z axis, and an arch spans
  /// x.
  Eigen::Vector3d own(const Eigen::Vector3d& point) const;
  /// Horizontal unit vector at an azimuth (rad) from its own x axis.
  Eigen::Vector3d towards(double azimuth) const;
  /// Horizontal unit vector at a point (m), away from its axis or from the middle of an arch; none for a
  /// wall.
  std::optional<Eigen::Vector3d> outward(const Eigen::Vector3d& point) const;
  bool operator==(const Sheet&) const = default;
};

}  // namespace cupola
