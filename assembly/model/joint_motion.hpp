#pragma once

#include <limits>

#include "assembly/base/named_enum.hpp"

namespace cupola {

enum class JointMotion { closed, sliding, opening, hinging };
constexpr auto enum_names(JointMotion) {
  return std::array{"closed", "sliding", "opening", "hinging"};
}

/// How the two sides of a joint of a mechanism move, gathered from its points. Speeds are relative to that of
/// the fastest block of the mechanism. A point stays closed if it moves across the joint at least as fast as
/// it opens: under the associated law a sliding point opens by friction times its sliding. With a friction
/// above 1 such a joint counts as opening.
struct JointSpeeds {
  /// Speed relative to the fastest block below which nothing moves.
  static constexpr double kStopped = 1e-3;

  double opening = 0.0;  ///< largest normal speed of a point, >= 0
  double sliding = 0.0;  ///< largest tangential speed of a point that stays closed, >= 0
  double least_opening = std::numeric_limits<double>::infinity();  ///< least normal speed of a point
  bool stays_closed = false;                                       ///< at a point at least

  /// A point with these relative speeds of the second side, along the normal and across it.
  void add(double normal, double tangential);
  /// A joint that stays closed somewhere slides or hinges, by the faster; one that does not opens.
  JointMotion motion() const;
  /// The part of the opening that is no dilatancy of the sliding.
  double turning() const;
};

}  // namespace cupola
