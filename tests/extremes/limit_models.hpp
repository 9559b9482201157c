#pragma once

#include "tests/extremes/extreme_scene.hpp"

namespace cupola {

/// A random model with a limit in one parameter, which the case names: the lateral acceleration of walls,
/// piles, arches, domes and imported blocks, the friction of wedges and leaning cards.
struct LimitModel {
  std::string name;
  Scene scene;                ///< a limit analysis
  bool stands_above = false;  ///< friction: the structure stands above the limit; loads: below
};
LimitModel limit_model(std::uint64_t seed);

}  // namespace cupola
