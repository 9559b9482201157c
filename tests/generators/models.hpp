#pragma once

#include "assembly/case/case.hpp"

namespace cupola {

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
