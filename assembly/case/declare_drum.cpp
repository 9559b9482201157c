#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_openings(Section& s, Openings& openings) {
  s.integer("per_ring", openings.per_ring, {.min = 0, .max = 1000000},
            "number of openings at each position of `at`, equally spaced; 0: one on each side of the plan");
  s.numbers("at", openings.at, {.min = 0, .below = 1},
            "middles of the openings, in spacings from the first corner");
  s.required_number("width", openings.width, {.unit = "m", .above = 0}, "width on the inner face");
  s.required_number("height", openings.height, {.unit = "m", .above = 0}, "height of the opening");
  s.required_number("sill", openings.sill, {.unit = "m", .min = 0},
                    "height of its lower edge above the foot of the drum");
  s.number("lintel", openings.lintel, {.unit = "m", .min = 0},
           "height of the block that covers the opening; 0: one course");
  s.number("bearing", openings.bearing, {.unit = "m", .above = 0},
           "length on which the lintel rests beyond each side of the opening, on the inner face");
}

/// The edges of an opening and of its lintel must be beds.
void check_openings(const Section& s, const Drum& drum) {
  const double course = drum.height / rings_of(*finest_bond(drum));
  for (size_t i = 0; i < drum.openings.size(); ++i) {
    const Openings& group = drum.openings[i];
    const double top = group.sill + group.height, lintel = group.lintel > 0.0 ? group.lintel : course;
    const auto level = [&](const char* what, double height) {
      const double courses = height / course;
      s.rule(std::abs(courses - std::round(courses)) < 1e-6, "openings",
             fmt::format("openings[{}]: {} at {:.6g} m lies between two beds; courses are {:.6g} m high, so "
                         "that {:.6g} and {:.6g} m are beds",
                         i, what, height, course, course * std::floor(courses), course * std::ceil(courses)));
    };
    s.rule(top < drum.height * (1.0 + 1e-9), "openings",
           fmt::format(
               "openings[{}]: sill {:.6g} m + height {:.6g} m reach above the drum, which is {:.6g} m high",
               i, group.sill, group.height, drum.height));
    s.rule(top + lintel < drum.height * (1.0 + 1e-9), "openings",
           fmt::format("openings[{}]: no room for a lintel of {:.6g} m above the opening, which ends {:.6g} "
                       "m below the top of the drum",
                       i, lintel, drum.height - top));
    level("sill", group.sill);
    level("top", top);
    level("top of the lintel", top + lintel);
    s.rule(!group.at.empty(), "openings", fmt::format("openings[{}]: `at` must give a position", i));
  }
}

}  // namespace

void declare_drum(Section& s, Drum& drum) {
  s.required_number("height", drum.height, {.unit = "m", .above = 0},
                    "height from the fixed base to the springing");
  s.expect({"height", drum.height, "m", 0.05, 250.0, kKilometres, kMillimetres});
  if (s.gives("wythes")) {
    s.refuse("thickness", "remove this key: `wythes` gives the thickness of each wythe");
  } else {
    s.required_number("thickness", drum.thickness, {.unit = "m", .above = 0},
                      "thickness of the wall, from the inner face of the surface at the springing outwards");
    s.expect({"thickness", drum.thickness, "m", kThinnest, kThickest, kKilometres, kMillimetres});
  }
  declare_masonry(s, drum);
  s.list("openings", drum.openings, "windows, each under a lintel in one block", declare_openings);
  for (const Bond* bond : bonds_of(drum))
    s.rule(std::visit([](const auto& b) { return b.blocks_per_ring; }, *bond) >= 3,
           drum.wythes.empty() ? "bond" : "wythes", "bond.blocks_per_ring must be >= 3 on a closed ring");
  if (drum.height > 0.0) check_openings(s, drum);  // not so while the keys are described
}

}  // namespace cupola
