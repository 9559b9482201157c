#pragma once

#include <array>
#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Friction and compliance of one contact point.
struct JointLaw {
  double mu = 0.0;
  double compliance_normal = 0.0;      ///< m/N per point, or m3/N per area in a JointTable
  double compliance_tangential = 0.0;  ///< same unit
};

/// The law of every sort of joint in every ring, with the case's changes worked in.
class JointTable {
 public:
  JointTable() = default;
  explicit JointTable(const Joints& joints, int num_rings);

  /// Law of a contact point of the patch that stands for `area` (m2), at full friction.
  JointLaw law(const Assembly& assembly, const Patch& patch, double area) const;
  double largest_normal_compliance() const;  ///< in the unit of the case

 private:
  static constexpr int kSorts = 5;
  std::array<std::vector<JointLaw>, kSorts> laws_;  // by sort, then ring
  bool per_area_ = false;
};

/// The sort a joint belongs to: base, herringbone, bed, head, or `all` for what is none of these.
RingJoints::Sort joint_sort(const Assembly& assembly, const Patch& patch);

}  // namespace cupola
