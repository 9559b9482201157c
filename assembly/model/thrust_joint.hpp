#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// Of each stack the uppermost sheet that has an outside, as walls have not; the last stack first.
std::vector<const Sheet*> pushing_sheets(const Assembly& assembly);

/// The joints by which vaults push outwards on what bears them, in tables as in ranges: the sum of their
/// forces on the bearer along outward() is the thrust.
class ThrustJoints {
 public:
  explicit ThrustJoints(const Assembly& assembly);  ///< refers to it

  /// Horizontal unit vector outwards at a point (m) where a course is borne: Assembly::outward, but of an arch
  /// away from the middle of its stones. Cuts may have taken those on one side of its axis.
  Vec3 outward(int ring, const Vec3& point) const;
  /// True at the springing of an arch where its courses end, towards -x in its own frame.
  bool is_at_far_side(const Sheet& sheet, const Vec3& point) const;
  /// The block on which the stack of a sheet pushes outwards by a joint with this centroid (m) and unit normal
  /// of either sign: a support, or a block of an earlier stack that carries its first course, of an arch at
  /// the far side its last. -1 for other joints, also where the heads of two members meet in an upright mitre,
  /// or a wall stands on that course.
  int bearer(const Sheet& sheet, const Joint& joint, const Vec3& centroid, const Vec3& normal) const;

 private:
  Vec3 outward(const Sheet& sheet, const Vec3& point) const;

  const Assembly& assembly_;
  std::vector<double> middles_;  ///< m, of the arch of each sheet along x in its own frame
};

}  // namespace cupola
