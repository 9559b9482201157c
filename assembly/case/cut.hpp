#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assembly/base/named_enum.hpp"

namespace cupola {

/// A convex body that a member loses: a half-space, or a prism.
struct Cut {
  enum class Kind : std::uint8_t { plane, prism, cylinder, under, over };
  enum class Axis : std::uint8_t { x, y, z };
  /// What lies behind the faces of the cut: nothing, a fixed support, the same stones, parted by a joint, or
  /// another member, which loses what lies on this side.
  enum class As : std::uint8_t { free, held, joint, mitre };
  enum class Face : std::uint8_t { extrados, intrados };

  Kind kind = Kind::plane;
  As as = As::free;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, of a plane
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< not 0, into what is lost
  Axis axis = Axis::y;                                ///< along a prism or cylinder
  std::vector<double> u,
      v;  ///< m, corners of the convex outline of a prism: (y, z), (x, z) or (x, y) across its axis
  double centre_u = 0.0, centre_v = 0.0, radius = 1.0;  ///< m, of a cylinder, a prism over a regular polygon
  int sides = 16;                                       ///< >= 3, of that polygon
  std::optional<double> from, to;                       ///< m, along the axis; none: without end
  /// A barrel: what lies under its `face`, from end to end, is taken away. Or a groin vault: what lies over
  /// its intrados, which its supports continue downwards.
  /// Of a mitre: the member behind it.
  std::string member;
  Face face = Face::extrados;  ///< of that member
};
constexpr auto enum_names(Cut::Axis) {
  return std::array{"x", "y", "z"};
}
constexpr auto enum_names(Cut::As) {
  return std::array{"free", "held", "joint", "mitre"};
}
constexpr auto enum_names(Cut::Face) {
  return std::array{"extrados", "intrados"};
}

}  // namespace cupola
