#pragma once

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/generators/models.hpp"

// A wall less what cuts take from it, barrels, and the volume that is left.

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

inline VaultSurface barrel(double span, double thickness, double length) {
  VaultSurface surface;
  surface.plan.kind = Plan::Kind::line;
  surface.plan.length = length;
  surface.profile.kind = Profile::Kind::semicircle;
  surface.profile.span = span;
  surface.thickness = thickness;
  return surface;
}

/// m3, checked.
inline double volume_of(const Case& c, ModelReport* report) {
  check_and_report(c, report);
  EXPECT_LT(report->max_convexity_error, 1e-13);
  EXPECT_LT(report->max_overlap, 1e-10);
  EXPECT_NEAR(report->parts_volume, report->volume, 1e-12 * report->volume);
  return report->volume;
}

}  // namespace cupola::test
