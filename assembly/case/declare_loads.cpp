#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_top_load(Section& s, TopLoad& load) {
  s.required_number("weight_fraction", load.weight_fraction, {.min = 0},
                    "load over the weight of the free blocks");
}

}  // namespace

void declare_loads(Section& s, Loads& loads) {
  s.vector3("gravity", loads.gravity, {.unit = "m/s2"}, "acceleration of gravity, world axes");
  s.optional_section("lantern", loads.lantern, "vertical load on the top ring of a dome, spread by area",
                     declare_top_load);
  s.optional_section("top_load", loads.top_load, "vertical load on the top of a wall, spread by area",
                     declare_top_load);
}

}  // namespace cupola
