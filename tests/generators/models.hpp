#pragma once

#include "generators/generate.hpp"

namespace cupola {

/// Generates and checks the model of a case.
inline Assembly check_and_report(const Case& c, ModelReport* report) {
  GenerateReport whole;
  Assembly assembly = generate(c, &whole);
  *report = whole.model;
  return assembly;
}

inline Case dome_case(int rings = 40, int blocks_per_ring = 32, int slices_per_block = 4) {
  Case c;
  c.geometry.surface = DomeSurface{};
  c.geometry.bond = RunningBond{rings, blocks_per_ring, slices_per_block};
  return c;
}

inline Case wall_case(int rings, int blocks_per_ring) {
  Case c;
  c.geometry.surface = WallSurface{};
  c.geometry.bond = RunningBond{rings, blocks_per_ring, 2};
  return c;
}

}  // namespace cupola
