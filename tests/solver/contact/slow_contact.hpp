#pragma once

#include <algorithm>
#include <cmath>

#include "solver/contact/problem/cone.hpp"

namespace cupola::scenes {

/// Slow, independent reference: minimises 1/2 g E g + g y over the cone. For given g_n the optimal g_t points
/// against y_t, with the radius min(mu g_n, |y_t| / e_t). The remaining problem is convex in g_n; its slope
/// is bisected.
inline Vec3 slow_impulse(const ContactLaw& law, const Vec3& y) {
  const double y_t = y.tail<2>().norm();
  const auto radius = [&](double n) { return std::min(law.mu * n, y_t / law.e_t); };
  const auto slope = [&](double n) {
    const double r = radius(n);
    return law.e_n * n + y[0] + (r == law.mu * n ? law.mu * (law.e_t * r - y_t) : 0.0);
  };
  double low = 0.0, high = (std::abs(y[0]) + law.mu * y_t) / law.e_n;
  for (int k = 0; k < 1200; ++k) {
    const double n = 0.5 * (low + high);
    (slope(n) > 0.0 ? high : low) = n;
  }
  if (y_t == 0.0) return {low, 0, 0};
  return {low, -radius(low) * y[1] / y_t, -radius(low) * y[2] / y_t};
}

}  // namespace cupola::scenes
