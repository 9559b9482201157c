#include <algorithm>
#include <cmath>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_top_load(Section& s, TopLoad& load) {
  int given = 0;
  const auto one_of = [&](const char* key, double& value, const char* unit, const char* meaning) {
    std::optional<double> number;
    s.optional_number(key, number, {.unit = unit, .min = 0}, "none", meaning);
    value = number.value_or(0.0);
    given += number.has_value();
  };
  one_of("weight_fraction", load.weight_fraction, "", "load over the total weight of the free blocks");
  one_of("weight", load.weight, "N", "instead: the load");
  one_of("mass", load.mass, "kg", "instead: the mass, whose weight follows from `gravity`");
  s.rule(given == 1, "weight_fraction", "give one of weight_fraction, weight (N) and mass (kg)");
}

void declare_sharing_blocks(Section& s, SharingBlocks& over) {
  s.integer("course", over.course, {.min = -1}, "ring of the blocks; -1: any");
  s.text("member", over.member, "member with its copies, wythe or group of bonders; empty: any");
}

void declare_spread(Section& s, Spread& spread) {
  s.required_number("x", spread.x, {.unit = "m", .above = 0}, "length of the loaded rectangle along x");
  s.required_number("y", spread.y, {.unit = "m", .above = 0}, "along y");
  s.number("slope", spread.slope, {.min = 0, .max = 10}, "by which each side moves outwards per depth");
}

void declare_block_force(Section& s, BlockForce& load) {
  std::optional<BlockRef> block;
  s.optional_block("block", block, "that of the point", "number or name of the loaded block");
  load.block = block.value_or(BlockForce::kAtPoint);
  s.optional_vector3("point", load.point, {.unit = "m"}, "centroid",
                     "point of application, in the as-built geometry; without a block it chooses the block");
  s.optional_section("over", load.over, "instead of a block: free blocks that share the force by volume",
                     declare_sharing_blocks);
  s.optional_section("spread", load.spread,
                     "instead of a block: the force acts on a rectangle at the height of the point, as a "
                     "wheel on a road, and spreads through the fill to the extrados",
                     declare_spread);
  s.rule(block || load.over || load.point, "block", "give the loaded block, a point or `over`");
  s.rule(!load.spread || (load.point && !block && !load.moment), "spread",
         "requires a point, and neither a block nor a moment");
  s.rule(!load.over || (!block && !load.point), "over",
         "shares the force among blocks: leave out block and point");
  s.vector3("force", load.force, {.unit = "N"}, "force, of constant direction");
  s.optional_vector3(
      "moment", load.moment, {.unit = "N m"}, "none",
      "moment on the block, right-handed: of forces that keep their directions while it turns");
  s.rule(!load.over || !load.moment, "moment", "acts on one block: give `block` instead of `over`");
  declare_time(s, "time", load.time, "factor on force and moment");
}

void declare_fill(Section& s, Fill& fill) {
  s.required_number("level", fill.level, {.unit = "m"}, "height of its level surface");
  s.optional_number("from", fill.from, {.unit = "m"}, "on the masonry",
                    "height above which it lies, over other fill");
  s.required_number("unit_weight", fill.unit_weight, {.unit = "N/m3", .above = 0}, "weight per volume");
  s.expect({"unit_weight", fill.unit_weight, "N/m3", kLightest, kHeaviest, "in kN/m3? Write 18000",
            "too many digits? Soil weighs about 18000 N/m3"});
  s.number(
      "horizontal", fill.horizontal, {.min = 0, .max = 10},
      "horizontal over vertical stress, on faces that it lies on or against: 0 none, 0.5 loose soil at rest");
  s.rule(!fill.from || *fill.from < fill.level, "from", "must lie below level");
}

void declare_face_load(Section& s, FaceLoad& load) {
  s.choice("kind", load.faces, {FaceKind::extrados, FaceKind::intrados, FaceKind::top, FaceKind::free},
           "kind of the loaded faces");
  s.integer("from_ring", load.from_ring, {.min = 0}, "lowest ring");
  s.integer("to_ring", load.to_ring, {.min = 0}, "highest ring");
  s.rule(load.from_ring <= load.to_ring, "to_ring", "must be >= from_ring");
  s.text("member", load.member,
         "only faces of this member and its copies, wythe or group of bonders; empty: of all blocks");
  s.vector3("traction", load.traction, {.unit = "N/m2"}, "force per unit area, of constant direction");
  s.number("pressure", load.pressure, {.unit = "N/m2"},
           "pressure on the faces, in their as-built directions");
  s.optional_section("fill", load.fill, "backing or fill with a level surface on these faces", declare_fill);
  declare_time(s, "time", load.time, "factor on the load");
}

/// True if a fill on the extrados, which lies on the tops of walls, too, is given again on these tops.
bool gives_fill_of_tops_twice(const std::vector<FaceLoad>& loads) {
  const auto overlap = [](const Fill& a, const Fill& b) {
    return (!a.from || *a.from < b.level) && (!b.from || *b.from < a.level);
  };
  return std::ranges::any_of(loads, [&](const FaceLoad& a) {
    return a.fill && a.faces == FaceKind::extrados && a.member.empty() &&
           std::ranges::any_of(loads, [&](const FaceLoad& b) {
             return b.fill && b.faces == FaceKind::top && overlap(*a.fill, *b.fill);
           });
  });
}

void declare_heat(Section& s, BlockHeat& heat) {
  declare_region(s, heat.region, "the heated blocks; empty: all free blocks");
  s.number("change", heat.change, {.unit = "K"}, "change of temperature at the centroid of each block");
  s.number("through", heat.through, {.unit = "K/m"},
           "its growth along the outward normal of the extrados of each block, in addition");
  s.vector3("gradient", heat.gradient, {.unit = "K/m"}, "its growth along the world axes, in addition");
  s.required_number("expansion", heat.expansion, {.unit = "1/K", .above = 0}, "thermal strain per kelvin");
  s.flag("ground", heat.ground, "the fixed blocks expand with the others, as one body");
  declare_time(s, "time", heat.time, "factor on the change and its growth");
  s.rule(heat.change != 0.0 || heat.through != 0.0 || heat.gradient.norm() > 0.0, "change",
         "give change, through or gradient: this entry heats nothing");
  s.rule(!heat.ground || (heat.through == 0.0 && heat.gradient.isZero(0.0) && !heat.region.profile), "ground",
         "expands evenly: leave out through, gradient and profile");
  s.expect({"change", std::abs(heat.change), "K", 0.0, 200.0, "",
            "a temperature in kelvin? It is the change from the state as built"});
  s.expect({"expansion", heat.expansion, "1/K", 1e-6, 3e-5, "too many zeros? Brick expands by 6e-6 per K",
            "in 1e-6 per K? Write 6e-6"});
}

}  // namespace

void declare_loads(Section& s, Loads& loads) {
  s.vector3("gravity", loads.gravity, {.unit = "m/s2"}, "acceleration of gravity, world axes");
  if (const double g = loads.gravity.norm(); g > 0.0)
    s.expect({"gravity (its length)", g, "m/s2", 1.5, 1500.0, "a multiple of g? Gravity is in m/s2",
              "in mm/s2? Gravity is in m/s2"});
  s.expect({"gravity (z)", loads.gravity.z(), "m/s2", kNoLowerEnd, 0.0, "",
            "upward? The z axis points up, so that gravity is [0, 0, -9.81]"});
  s.optional_section("lantern", loads.lantern, "load on the top ring of a dome, with inertia, by area",
                     declare_top_load);
  if (loads.lantern)
    s.expect({"lantern.weight_fraction", loads.lantern->weight_fraction, "of the weight", 0.0, 1.0, "",
              "in per cent? 2 % is 0.02"});
  s.optional_section("top_load", loads.top_load, "the same on the tops of walls", declare_top_load);
  declare_time(s, "dead_load_time", loads.dead_load_time,
               "factor on gravity, lantern, top load and fill without `time`, not on the horizontal "
               "accelerations of limits");
  s.list("forces", loads.forces, "forces and moments on blocks", declare_block_force);
  s.list("faces", loads.faces, "loads on all faces of one kind", declare_face_load);
  s.rule(!gives_fill_of_tops_twice(loads.faces), "faces",
         "a fill on the extrados lies on the tops of walls, too: leave out that of kind top");
  s.list("heat", loads.heat, "changes of temperature, by which blocks expand", declare_heat);
}

}  // namespace cupola
