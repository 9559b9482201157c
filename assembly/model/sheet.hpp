#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace cupola {

/// What a member of the masonry is, for programs that must not know how it was drawn: a sheet of courses, which lie on
/// each other in the order of their numbers. The courses of several sheets have different numbers.
struct Sheet {
  /// Where thrust lines are drawn: nowhere, in the x-z plane of an arch, or at any azimuth about the z axis.
  enum class ThrustLines : std::uint8_t { none, one, by_azimuth };

  std::string name;
  int first_ring = 0;   ///< number of its first course
  int num_rings = 0;    ///< courses of the complete model
  bool closed = false;  ///< the last block of a course meets the first
  ThrustLines thrust_lines = ThrustLines::none;
  int sails = 1;  ///< equal parts about the z axis

  bool has_ring(int ring) const { return ring >= first_ring && ring < first_ring + num_rings; }
  /// Horizontal unit vector at a point (m), away from the z axis or from the middle of an arch; none for a wall.
  std::optional<Eigen::Vector3d> outward(const Eigen::Vector3d& point) const;
  bool operator==(const Sheet&) const = default;
};

}  // namespace cupola
