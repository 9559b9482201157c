#pragma once

#include <string>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"

namespace cupola {

/// Generates and checks the model of a case.
inline Assembly check_and_report(const Case& c, ModelReport* report) {
  GenerateReport whole;
  Assembly assembly = generate(c, &whole);
  *report = whole.model;
  return assembly;
}

/// The message with which the generator refuses a case; "" if it does not.
inline std::string refusal_of(const Case& c) {
  try {
    generate(c);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline Case dome_case(int rings = 40, int blocks_per_ring = 32, int slices_per_block = 4) {
  Case c;
  c.geometry.surface = DomeSurface{};
  c.geometry.bond = RunningBond{rings, blocks_per_ring, slices_per_block};
  return c;
}

/// A vertical wall over an octagon of the given span between corners, as a member that ends at z = 0 under
/// the vault of the case.
inline Member octagonal_drum(double span, double height, double thickness, const Bond& bond,
                             VaultSurface::Beds beds = VaultSurface::Beds::conical) {
  VaultSurface wall;
  wall.plan.kind = Plan::Kind::polygon;
  wall.profile.kind = Profile::Kind::straight;
  wall.profile.span = span;
  wall.profile.height = height;
  wall.thickness = thickness;
  wall.beds = beds;
  Member drum;
  drum.name = "drum";
  drum.at = Place{{0.0, 0.0, -height}, 0.0};
  drum.surface = wall;
  drum.bond = bond;
  return drum;
}

inline Case wall_case(int rings, int blocks_per_ring) {
  Case c;
  c.geometry.surface = WallSurface{};
  c.geometry.bond = RunningBond{rings, blocks_per_ring, 2};
  return c;
}

}  // namespace cupola
