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

/// Sorts of joints that can differ in their law. A base joint lies on a support, a herringbone joint touches
/// a herringbone block.
enum class JointSort { bed, head, herringbone_bed, herringbone_other, base, other };
constexpr int kJointSorts = 6;
JointSort joint_sort(const Assembly& assembly, const Patch& patch);

/// The law of every sort of joint in every ring, with the case's changes worked in.
class JointTable {
 public:
  JointTable() = default;
  explicit JointTable(const Joints& joints, int num_rings);

  /// Law of a contact point of the patch that stands for `area` (m2) and for `points`, at full friction.
  JointLaw law(const Assembly& assembly, const Patch& patch, double area, int points = 1) const;

 private:
  std::array<std::vector<JointLaw>, kJointSorts> laws_;  // by sort, then ring
  bool per_area_ = false;
};

}  // namespace cupola
