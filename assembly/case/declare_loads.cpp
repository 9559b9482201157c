#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_top_load(Section& s, TopLoad& load) {
  s.required_number("weight_fraction", load.weight_fraction, {.min = 0},
                    "load over the total weight of the free blocks");
}

void declare_block_force(Section& s, BlockForce& load) {
  s.required_block("block", load.block, "number or name of the loaded block");
  s.optional_vector3("point", load.point, {.unit = "m"}, "centroid",
                     "point of application, in the as-built geometry");
  s.vector3("force", load.force, {.unit = "N"}, "force, of constant direction");
  declare_time(s, "time", load.time, "factor on the force");
}

void declare_face_load(Section& s, FaceLoad& load) {
  s.choice("kind", load.faces, {FaceKind::extrados, FaceKind::intrados, FaceKind::top, FaceKind::free},
           "kind of the loaded faces");
  s.integer("from_ring", load.from_ring, {.min = 0}, "lowest ring");
  s.integer("to_ring", load.to_ring, {.min = 0}, "highest ring");
  s.text("member", load.member, "only faces of this wythe or group of bonders; empty: of all blocks");
  s.vector3("traction", load.traction, {.unit = "N/m2"}, "force per unit area, of constant direction");
  s.number("pressure", load.pressure, {.unit = "N/m2"},
           "pressure on the faces, in their as-built directions");
  declare_time(s, "time", load.time, "factor on the load");
}

}  // namespace

void declare_loads(Section& s, Loads& loads) {
  s.vector3("gravity", loads.gravity, {.unit = "m/s2"}, "acceleration of gravity, world axes");
  if (const double g = loads.gravity.norm(); g > 0.0)
    s.expect({"gravity (its length)", g, "m/s2", 1.5, 1500.0, "a multiple of g? Gravity is in m/s2",
              "in mm/s2? Gravity is in m/s2"});
  s.expect({"gravity (z)", loads.gravity.z(), "m/s2", kNoLowerEnd, 0.0, "",
            "upward? The z axis points up, so that gravity is [0, 0, -9.81]"});
  s.optional_section("lantern", loads.lantern, "vertical load on the top ring of a dome, distributed by area",
                     declare_top_load);
  if (loads.lantern)
    s.expect({"lantern.weight_fraction", loads.lantern->weight_fraction, "of the weight", 0.0, 1.0, "",
              "in per cent? 2 % is 0.02"});
  s.optional_section("top_load", loads.top_load, "vertical load on the top of a wall, distributed by area",
                     declare_top_load);
  declare_time(s, "dead_load_time", loads.dead_load_time, "factor on gravity, lantern and top load");
  s.list("forces", loads.forces, "forces on single blocks", declare_block_force);
  s.list("faces", loads.faces, "loads on all faces of one kind", declare_face_load);
}

}  // namespace cupola
