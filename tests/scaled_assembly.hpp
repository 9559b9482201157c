#pragma once

#include <cmath>
#include <utility>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// The same model, every length times `length`, every weight times `weight`.
inline Assembly scaled(Assembly assembly, double length, double weight) {
  for (Vec3& x : assembly.vertices) x *= length;
  for (Block& block : assembly.blocks) block.density *= weight / std::pow(length, 3);
  compute_mass_properties(&assembly);
  return assembly;
}

/// Factors on lengths and on weights: powers of two, which change no digit.
constexpr std::pair<double, double> kScales[] = {
    {0x1p-10, 1.0}, {0x1p10, 1.0}, {1.0, 0x1p-6}, {1.0, 0x1p6}, {0x1p-10, 0x1p-6}};

}  // namespace cupola
