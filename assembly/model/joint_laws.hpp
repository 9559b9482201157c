#pragma once

#include <optional>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/model/time_function.hpp"

namespace cupola {

/// What one contact (or one square metre of joint) yields per newton.
struct Compliance {
  enum class Per { point, area };
  double normal = 1e-8;      ///< m/N per contact point, or m3/N per area, >= 0
  double tangential = 1e-8;  ///< same unit, >= 0
  Per per = Per::point;      ///< the case must say which
};
constexpr auto enum_names(Compliance::Per) {
  return std::array{"point", "area"};
}

/// What a group of joints has of its own; the rest is as everywhere.
struct JointLawChange {
  std::optional<double> friction;
  std::optional<double> normal, tangential;  ///< compliance, in the unit of Joints::compliance
};

/// Sorts of joints that may have a law of their own. `base` touches a fixed support, `herringbone` touches a
/// herringbone block; of the others, `bed` lies between rings and `head` within one.
struct RingJoints {
  enum class Sort {
    all,
    bed,
    head,
    herringbone,
    base,
    laid_bed  ///< every bed, also on supports and of herringbone blocks
  };
  int from = 0, to = 0;  ///< rings, both included: course of the upper part of the joint, the lowest is 0
  Sort sort = Sort::all;
  JointLawChange law;
};
constexpr auto enum_names(RingJoints::Sort) {
  return std::array{"all", "bed", "head", "herringbone", "base", "laid_bed"};
}

/// Laws of the joints. The later of these wins: the general values, those of the sort, those of the ring.
struct Joints {
  double friction = 0.4;  ///< mu, >= 0
  Compliance compliance;
  std::optional<JointLawChange> bed, head, herringbone, base;
  std::vector<RingJoints> rings;
  TimeFunction friction_time;  ///< factor on every friction coefficient
};

}  // namespace cupola
