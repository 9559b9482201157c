#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/declare.hpp"

namespace cupola {

void declare_chain(Section& s, Chain& chain) {
  s.text("name", chain.name, "name in tables and figures; by default its number");
  s.text("member", chain.member, "member in which it lies, or a copy, NAME 2; empty: the last");
  s.choice(
      "type", chain.type,
      "polygon: straight bars between anchors in the masonry; clamps: a bar across each head joint; rods: "
      "bars from one side of a barrel to the other");
  s.integer("course", chain.course, {.min = -1, .max = kMostRings},
            "course in whose middle the chain lies; -1: at height");
  s.optional_number("height", chain.height, {.unit = "m"}, "that of the course",
                    "z of the bars in the frame of the member, instead of a course");
  s.number("place", chain.place, {.min = 0, .max = 1},
           "place in the thickness, from 0 at the intrados to 1 at the extrados");
  s.numbers("at", chain.at, {.unit = "m", .min = 0},
            "where rods lie, from the beginning of the barrel; none: one in its middle");
  s.integer("links", chain.links, {.min = 0, .max = kMostRings},
            "bars of a polygon, equal in azimuth, from a corner; 0: from block to block");
  s.number("clamp_length", chain.clamp_length, {.unit = "m", .above = 0},
           "length of a clamp, half on each side of its joint");
  s.integer("long_blocks", chain.long_blocks, {.min = 0, .max = kMostRings},
            "number of equal blocks that replace those of the bond in the course; 0: those of the bond");
  s.number("axial_stiffness", chain.axial_stiffness, {.unit = "N", .above = 0},
           "modulus times section of a bar");
  s.expect({"axial_stiffness", chain.axial_stiffness, "N", 1e5, 1e12, "in kN? 1 kN is 1000 N",
            "a modulus in N/m2? It is modulus times section"});
  s.optional_number("yield_force", chain.yield_force, {.unit = "N", .above = 0}, "none",
                    "tension at which a bar elongates plastically");
  if (chain.yield_force)
    s.expect({"yield_force", *chain.yield_force, "N", 1e3, 1e10, "in kN? 1 kN is 1000 N",
              "a strength in N/m2? It is strength times section"});
  s.number("slack", chain.slack, {.unit = "m", .min = 0}, "elongation at which each bar begins to carry");
  s.number("prestress", chain.prestress, {.unit = "N", .min = 0}, "tension as built");
  const bool polygon = chain.type == Chain::Type::polygon, rods = chain.type == Chain::Type::rods;
  s.rule((chain.course >= 0) != chain.height.has_value(), "course",
         "a chain has either a course or a height");
  s.rule(polygon || chain.links == 0, "links", "requires type: polygon");
  s.rule(polygon || rods || chain.course >= 0, "height", "clamps require a course");
  s.rule(!rods || chain.height, "height", "rods require a height");
  s.rule(rods || chain.at.empty(), "at", "requires type: rods");
  s.rule(chain.type == Chain::Type::clamps || chain.clamp_length == Chain{}.clamp_length, "clamp_length",
         "requires type: clamps");
  s.rule(chain.links == 0 || chain.links >= 3, "links", "must be 0 or at least 3");
  s.rule(chain.long_blocks == 0 || (chain.long_blocks >= 3 && chain.course >= 0), "long_blocks",
         "requires a course, and at least 3 blocks");
  s.rule(chain.slack == 0.0 || chain.prestress == 0.0, "slack", "a chain has either slack or prestress");
  s.rule(!chain.yield_force || chain.prestress <= *chain.yield_force, "prestress", "must be <= yield_force");
}

void check_chain(const Section& s, const Geometry& geometry, const Chain& chain) {
  std::vector<std::string> names;
  for (const Member* member : members_of(geometry)) names.push_back(member->name);
  const Member* member = member_named(geometry, chain.member);
  const std::string near = nearest_name(chain.member, names);
  s.rule(member, "chains",
         fmt::format("no member is called {}{}", chain.member,
                     near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  const auto has_copies = [](const Member* m) { return m->copies || m->mirror; };
  s.rule(!chain.member.empty() || std::ranges::none_of(members_of(geometry), has_copies), "chains",
         fmt::format("in a model with copies, each names its `member`, of {}", fmt::join(names, ", ")));
  if (!member) return;
  const SurfaceTraits traits = traits_of(member->surface);
  const int rings = std::visit([](const auto& bond) { return bond.rings; }, *finest_bond(*member));
  if (chain.type == Chain::Type::rods)
    s.rule(traits.thrust_lines == Sheet::ThrustLines::one, "chains", "rods require an arch or barrel");
  else
    s.rule(traits.closed, "chains", "requires a whole dome or octagonal vault");
  s.rule(chain.type != Chain::Type::rods || !geometry.stage, "chains",
         "rods require a model without a stage");
  s.rule(chain.course < rings, "chains", "course must be < bond.rings");
  s.rule(chain.long_blocks == 0 || member->wythes.empty(), "chains",
         "long_blocks requires a shell without wythes");
  s.rule(chain.long_blocks == 0 || !has_copies(member), "chains",
         "long_blocks requires a member without copies");
}

}  // namespace cupola
