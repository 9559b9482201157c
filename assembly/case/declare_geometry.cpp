#include <utility>

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

void declare_octagonal_vault(Section& s, OctagonalVault& vault) {
  using enum OctagonalVault::Construction;
  using enum OctagonalVault::Extrados;
  s.integer("sails", vault.sails, {.min = 3, .max = 1000}, "sides of the plan");
  s.number("span", vault.span, {.unit = "m", .above = 0},
           "clear distance of opposite corners at the springing");
  s.number("radius_ratio", vault.radius_ratio, {.min = 0.5, .max = 1e3},
           "radius of the corner arc over span: 0.8 pointed fifth");
  s.number("thickness", vault.thickness, {.unit = "m", .above = 0}, "thickness of the shell; see extrados");
  s.number("crown_angle_deg", vault.crown_angle_deg, {.unit = "deg", .above = 0, .below = 90},
           "angle of the last bed at the corner");
  s.choice("construction", vault.construction,
           "beds on cones about the axis, in planes normal to each sail, or level");
  s.choice("extrados", vault.extrados,
           "where the thickness is measured: normal to the sail, on the corner or mid-sail section, along "
           "level beds");
}

void declare_arch(Section& s, ArchSurface& arch) {
  s.number("span", arch.span, {.unit = "m", .above = 0}, "clear span of the full arc at z = 0");
  s.number("radius_ratio", arch.radius_ratio, {.min = 0.5, .max = 1e3},
           "intrados radius over span: 0.5 one circle");
  s.number("thickness", arch.thickness, {.unit = "m", .above = 0}, "radial");
  s.number("width", arch.width, {.unit = "m", .above = 0}, "along y");
  s.number("half_embrace_deg", arch.half_embrace_deg, {.unit = "deg", .above = 0, .below = 180},
           "angle from the crown to the springing");
  s.integer("voussoir_segments", arch.voussoir_segments, {.min = 1, .max = 1000},
            "straight pieces of a voussoir's curved faces");
}

void declare_wall(Section& s, WallSurface& wall) {
  s.number("length", wall.length, {.unit = "m", .above = 0}, "along x");
  s.number("height", wall.height, {.unit = "m", .above = 0}, "along z");
  s.number("thickness", wall.thickness, {.unit = "m", .above = 0}, "along y");
}

void declare_surface(Section& s, Surface& surface) {
  s.variant<Surface>(
      "type", surface,
      {alternative<Surface>("dome", "dome of revolution, two arcs", declare_dome),
       alternative<Surface>("octagonal_vault", "cluster vault of cylindrical sails over a polygon",
                            declare_octagonal_vault),
       alternative<Surface>("arch", "barrel arch of two arcs", declare_arch),
       alternative<Surface>("wall", "plane wall", declare_wall)},
      "shape of the shell");
}

void declare_grid(Section& s, int& rings, int& blocks_per_ring, int& refine) {
  s.integer("rings", rings, {.min = 1, .max = kMostRings},
            "rings of a dome, courses of a wall, voussoirs of an arch");
  s.integer("blocks_per_ring", blocks_per_ring, {.min = 1, .max = kMostCells},
            "whole blocks in each ring; at least 3 on a closed ring");
  s.integer("refine", refine, {.min = 1, .max = 1000},
            "each course becomes so many courses, each block so many blocks, by the same rule");
}

/// `slices`: cells per whole block along the ring.
template <class SomeBond>
void check_cells(const Section& s, const SomeBond& bond, double slices) {
  const double courses = 1.0 * bond.rings * bond.refine;
  s.rule(courses <= kMostRings, "refine", "rings x refine must be <= 1e5");
  s.rule(courses * bond.blocks_per_ring * bond.refine * slices <= kMostCells, "blocks_per_ring",
         "rings x blocks_per_ring x slices x refine^2 must be <= 2e7 cells");
}

constexpr const char* kPhase = "block widths from the first corner to the first joint or spiral";
constexpr const char* kNoPhase = "off the corners";

void declare_running_bond(Section& s, RunningBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 2, .max = 64},
            "convex cells per block along the ring, even");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  s.rule(bond.slices_per_block % 2 == 0, "slices_per_block",
         "must be even: odd rings are shifted by half a block");
  check_cells(s, bond, bond.slices_per_block);
}

void declare_stack_bond(Section& s, StackBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 1, .max = 64},
            "convex cells per block along the ring");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  check_cells(s, bond, bond.slices_per_block);
}

void declare_herringbone_bond(Section& s, HerringboneBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("spirals", bond.spirals, {.min = 1, .max = kMostRings}, "number of spirals or meridian strips");
  s.integer("rings_per_vertical", bond.rings_per_vertical, {.min = 1, .max = 1000},
            "height of an upright block");
  s.integer("verticals_per_block", bond.verticals_per_block, {.min = 1, .max = 1000},
            "whole block's width over an upright block's");
  s.choice("path", bond.path, "uprights climb in spirals or straight up");
  s.choice("chirality", bond.chirality, "right climbs counter-clockwise seen from above");
  s.choice("beside", bond.beside,
           "head joints of the flat blocks: step with the spirals, half bond, or on meridians");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  s.integer("slices_per_vertical", bond.slices_per_vertical, {.min = 1, .max = 64},
            "convex cells per upright block along the ring");
  s.rule(bond.beside != HerringboneBond::Beside::half ||
             bond.verticals_per_block * bond.slices_per_vertical % 2 == 0,
         "beside",
         "half needs an even number of slices per block: verticals_per_block x slices_per_vertical");
  check_cells(s, bond, 1.0 * bond.verticals_per_block * bond.slices_per_vertical);
}

void declare_fill_bond(Section& s, FillBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 1, .max = 64},
            "possible cuts per mean block width");
  s.number("narrowest", bond.narrowest, {.above = 0, .max = 1}, "narrowest block over the mean width");
  s.number("widest", bond.widest, {.min = 1, .max = 10}, "widest block over the mean width");
  check_cells(s, bond, bond.slices_per_block);
}

void declare_bond(Section& s, Bond& bond) {
  s.variant<Bond>(
      "type", bond,
      {alternative<Bond>("running", "odd rings shifted by half a block", declare_running_bond),
       alternative<Bond>("stack", "head joints aligned", declare_stack_bond),
       alternative<Bond>("herringbone", "upright blocks climb through whole ones", declare_herringbone_bond),
       alternative<Bond>("fill", "unequal blocks that avoid the joints below", declare_fill_bond)},
      "how the shell is cut into blocks");
}

void declare_stage(Section& s, Stage& stage) {
  s.required_integer("rings", stage.rings, {.min = 1, .max = kMostRings}, "rings built so far");
}

void declare_block_density(Section& s, BlockDensity& change) {
  s.texts("blocks", change.blocks, "names of the blocks");
  s.required_number("density", change.density, {.unit = "kg/m3", .above = 0}, "of these blocks");
}

void declare_import(Section& s, ImportedBlocks& import) {
  using enum ImportedBlocks::Format;
  s.file("file", import.path, "blocks to import", true);
  s.choice("format", import.format,
           "of the file; automatic goes by its ending (.json: compas, .csv and .txt: bricks)");
  s.number("metres_per_unit", import.metres_per_unit, {.unit = "m", .above = 0}, "length of the file's unit");
  s.choice("up", import.up, "the file's upward axis");
  s.texts("supports", import.supports, "names of the blocks that are fixed");
  s.flag("flagged_supports", import.flagged_supports, "fix the blocks that the file marks as fixed");
  s.optional_number("fixed_below", import.fixed_below, {.unit = "m"}, "none",
                    "fix the blocks whose centroid lies below this height");
  s.list("densities", import.densities, "blocks of a density of their own", declare_block_density);
  s.file("springs", import.springs, "ties that only pull, brick CSV");
  s.file("rods", import.rods, "rigid rods, brick CSV");
  s.number("weld", import.weld, {.above = 0, .max = 0.1},
           "vertices nearer than this times the block's size are one");
  s.number("facet_angle", import.facet_angle, {.unit = "rad", .above = 0, .max = 0.1},
           "triangles within this angle are one plane facet");
  s.number("snap", import.snap, {.unit = "m", .min = 0},
           "opposed facets nearer than this are laid in one plane");
  s.number("most_overlap", import.most_overlap, {.unit = "m", .min = 0},
           "deeper overlaps of blocks are an error");
  s.number("joint_gap", import.joint_gap, {.unit = "m", .min = 0}, "faces nearer than this count as a joint");
}

}  // namespace

void declare_geometry(Section& s, Geometry& geometry) {
  s.optional_section("import", geometry.imported, "blocks cut by others, instead of surface and bond",
                     declare_import);
  if (geometry.imported) return;
  s.section("surface", geometry.surface, "shape of the masonry shell", declare_surface);
  s.section("bond", geometry.bond, "pattern of the blocks", declare_bond);
  s.optional_section("stage", geometry.stage, "builds the lower rings only", declare_stage);
  s.number("support_width", geometry.support_width, {.unit = "m", .above = 0},
           "how far the fixed base reaches beyond the shell");

  const auto [rings, blocks_per_ring] =
      std::visit([](const auto& bond) { return std::pair(bond.rings, bond.blocks_per_ring); }, geometry.bond);
  s.rule(!geometry.stage || geometry.stage->rings <= rings, "stage", "stage.rings must be <= bond.rings");
  s.rule(!traits_of(geometry.surface).closed || blocks_per_ring >= 3, "bond",
         "bond.blocks_per_ring must be >= 3 on a closed ring");
}

void declare_imperfections(Section& s, Imperfections& imperfections) {
  s.number("gap", imperfections.gap, {.unit = "m", .min = 0}, "joints open by random amounts up to this");
  s.number("noise", imperfections.noise, {.unit = "m", .min = 0},
           "faces and corners move by random amounts up to this; joints stay closed");
  s.integer("seed", imperfections.seed, {.min = 0}, "of the random numbers");
}

}  // namespace cupola
