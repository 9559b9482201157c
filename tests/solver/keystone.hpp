#pragma once

#include "tests/solver/motion_scenes.hpp"

namespace cupola::testing {

/// Keystone of 1 m between fixed walls whose distance grows downwards by `slope` on each side: forces that
/// carry it exist from friction `slope` on.
inline Assembly keystone(double slope) {
  Assembly assembly;
  const double foot = 1.0 + slope, head = 1.0;
  add_voussoir({Eigen::Vector2d{-foot - 2, 0}, {-foot, 0}, {-head, 1}, {-head - 2, 1}}, 1.0, 2000.0, true, 0,
               &assembly);
  add_voussoir({Eigen::Vector2d{foot, 0}, {foot + 2, 0}, {head + 2, 1}, {head, 1}}, 1.0, 2000.0, true, 0,
               &assembly);
  add_voussoir({Eigen::Vector2d{-foot, 0}, {foot, 0}, {head, 1}, {-head, 1}}, 1.0, 2000.0, false, 0,
               &assembly);
  compute_mass_properties(&assembly);
  return assembly;
}

}  // namespace cupola::testing
