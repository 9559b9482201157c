#pragma once

#include <utility>
#include <vector>

#include "tests/generators/models.hpp"

// A wall less what cuts take from it.

namespace cupola::test {

constexpr double kLength = 4.0, kHeight = 3.0, kThickness = 0.5;  // m
constexpr double kInner = 5.0;                                    // m, x of the inner face

/// A wall along y.
inline Case wall(std::vector<Cut> cuts) {
  VaultSurface surface;
  surface.plan.kind = Plan::Kind::line;
  surface.plan.length = kLength;
  surface.profile.kind = Profile::Kind::straight;
  surface.profile.height = kHeight;
  surface.thickness = kThickness;
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = RunningBond{6, 4, 2};
  c.geometry.cuts = std::move(cuts);
  return c;
}

inline Cut plane(const Vec3& point, const Vec3& normal, Cut::As as = Cut::As::free) {
  Cut cut;
  cut.point = point;
  cut.normal = normal;
  cut.as = as;
  return cut;
}

}  // namespace cupola::test
