#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

// A bound on the grid, so that a slip of the keyboard is a message and not an exhausted machine. The largest
// study of the project has 1.3 million cells.
constexpr double kMostCells = 2e7;
constexpr int kMostRings = 100000;

void declare_dome(Section& s, DomeSurface& dome) {
  s.number("span", dome.span, {.unit = "m", .above = 0}, "clear diameter at the springing");
  s.number("radius_ratio", dome.radius_ratio, {.min = 0.5, .max = 1e3},
           "intrados radius over span: 0.5 hemisphere, 0.8 pointed fifth");
  s.number("thickness", dome.thickness, {.unit = "m", .above = 0}, "radial thickness of the shell");
  s.number("crown_angle_deg", dome.crown_angle_deg, {.unit = "deg", .above = 0, .below = 90},
           "angle of the last bed above the springing");
}

void declare_wall(Section& s, WallSurface& wall) {
  s.number("length", wall.length, {.unit = "m", .above = 0}, "along x");
  s.number("height", wall.height, {.unit = "m", .above = 0}, "along z");
  s.number("thickness", wall.thickness, {.unit = "m", .above = 0}, "along y");
}

void declare_running_bond(Section& s, RunningBond& bond) {
  s.integer("rings", bond.rings, {.min = 1, .max = kMostRings}, "rings of a dome, courses of a wall");
  s.integer("blocks_per_ring", bond.blocks_per_ring, {.min = 1, .max = kMostCells},
            "whole blocks in each ring; at least 3 on a dome");
  s.integer("slices_per_block", bond.slices_per_block, {.min = 2, .max = 64},
            "convex cells per block along the ring, even");
  s.rule(bond.slices_per_block % 2 == 0, "slices_per_block",
         "must be even: odd rings are shifted by half a block");
  s.rule(1.0 * bond.rings * bond.blocks_per_ring * bond.slices_per_block <= kMostCells, "blocks_per_ring",
         "rings x blocks_per_ring x slices_per_block must be <= 2e7 cells");
}

void declare_surface(Section& s, Surface& surface) {
  s.variant<Surface>("type", surface,
                     {alternative<Surface>("dome", "dome of revolution, two arcs", declare_dome),
                      alternative<Surface>("wall", "plane wall", declare_wall)},
                     "shape of the shell", {"octagonal_vault"});
}

void declare_bond(Section& s, Bond& bond) {
  s.variant<Bond>("type", bond, {alternative<Bond>("running", "running bond", declare_running_bond)},
                  "how the shell is cut into blocks", {"herringbone", "fill"});
}

void declare_stage(Section& s, Stage& stage) {
  s.required_integer("rings", stage.rings, {.min = 1, .max = kMostRings}, "rings built so far");
}

}  // namespace

void declare_geometry(Section& s, Geometry& geometry) {
  s.section("surface", geometry.surface, "shape of the masonry shell", declare_surface);
  s.section("bond", geometry.bond, "pattern of the blocks", declare_bond);
  s.optional_section("stage", geometry.stage, "builds the lower rings only", declare_stage);
  s.number("support_width", geometry.support_width, {.unit = "m", .above = 0},
           "how far the fixed base reaches beyond the shell");

  const auto* running = std::get_if<RunningBond>(&geometry.bond);
  if (!running) return;
  s.rule(!geometry.stage || geometry.stage->rings <= running->rings, "stage",
         "stage.rings must be <= bond.rings");
  s.rule(!std::holds_alternative<DomeSurface>(geometry.surface) || running->blocks_per_ring >= 3, "bond",
         "bond.blocks_per_ring must be >= 3 on a dome");
}

}  // namespace cupola
