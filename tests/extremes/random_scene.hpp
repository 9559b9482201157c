#pragma once

#include <cstdint>

#include "tests/extremes/extreme_scene.hpp"

namespace cupola {

/// A wall of random blocks, or a pile of random boxes turned about the vertical, with random compliances,
/// friction, gaps and loads. The same seed gives the same scene on every machine.
Scene random_scene(std::uint64_t seed, FrictionLaw law);

/// The row of a random scene. Under the associated law the forces, or that there is no equilibrium, are
/// known in extended precision; under Coulomb's law only the balance of the whole is.
ExtremeScene random_row(std::uint64_t seed, FrictionLaw law);

/// The row of a tower of 3 to 300 random boxes, beside or above each other's middle, with joints from rigid to
/// soft, of which it is known whether it stands.
ExtremeScene random_tower_row(std::uint64_t seed, FrictionLaw law);

}  // namespace cupola
