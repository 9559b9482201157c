#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

// Bounds on the grid, so that a typing error gives a message rather than exhausts memory. The largest study
// of the project has 1.3 million cells.
constexpr double kMostCells = 2e7;
constexpr int kMostRings = 100000;

/// An angle of a vault. Angles in radians are at most pi.
void expect_angle(const Section& s, const char* key, double value) {
  s.expect({key, value, "deg", 4.0, 180.0, kRadians, ""});
}

void declare_dome(Section& s, DomeSurface& dome) {
  s.number("span", dome.span, {.unit = "m", .above = 0}, "inner diameter at the springing");
  expect_length(s, "span", dome.span);
  s.number("radius_ratio", dome.radius_ratio, {.min = 0.5, .max = 1e3},
           "radius of the intrados over span: 0.5 hemisphere, 0.8 pointed-fifth profile");
  declare_shell_thickness(s, dome.thickness, 0.5 * dome.span, "thickness of the shell, measured radially");
  s.number("crown_angle_deg", dome.crown_angle_deg, {.unit = "deg", .above = 0, .below = 90},
           "angle of the uppermost bed above the springing plane");
  expect_angle(s, "crown_angle_deg", dome.crown_angle_deg);
}

void declare_octagonal_vault(Section& s, OctagonalVault& vault) {
  s.integer("sails", vault.sails, {.min = 3, .max = 1000}, "number of sails, one on each side of the plan");
  s.number("span", vault.span, {.unit = "m", .above = 0},
           "inner distance between opposite corners at the springing");
  expect_length(s, "span", vault.span);
  s.number("radius_ratio", vault.radius_ratio, {.min = 0.5, .max = 1e3},
           "radius of the corner arc over span: 0.8 pointed-fifth profile");
  declare_shell_thickness(s, vault.thickness, 0.5 * vault.span,
                          "thickness of the shell, measured as the key extrados defines");
  s.number("crown_angle_deg", vault.crown_angle_deg, {.unit = "deg", .above = 0, .below = 90},
           "angle of the uppermost bed above the springing plane, at the corner");
  expect_angle(s, "crown_angle_deg", vault.crown_angle_deg);
  s.choice("construction", vault.construction,
           "beds lie on cones about the axis, in planes normal to each sail, or level");
  s.choice("extrados", vault.extrados,
           "where the thickness is measured: normal to the sail, on the corner section, on the mid-sail "
           "section, or along level beds");
}

void declare_arch(Section& s, ArchSurface& arch) {
  s.number("span", arch.span, {.unit = "m", .above = 0}, "inner span of the full arc at z = 0");
  expect_length(s, "span", arch.span);
  s.number("radius_ratio", arch.radius_ratio, {.min = 0.5, .max = 1e3},
           "radius of the intrados over span: 0.5 semicircular, above 0.5 pointed");
  declare_shell_thickness(s, arch.thickness, 0.5 * arch.span, "thickness, measured radially");
  s.number("width", arch.width, {.unit = "m", .above = 0}, "dimension along y");
  expect_length(s, "width", arch.width, kThinnest);
  s.number("half_embrace_deg", arch.half_embrace_deg, {.unit = "deg", .above = 0, .below = 180},
           "angle at the centre of each arc, from the vertical down to the springing; 90: springings level "
           "with the centre, as of a semicircle");
  expect_angle(s, "half_embrace_deg", arch.half_embrace_deg);
  s.integer("voussoir_segments", arch.voussoir_segments, {.min = 1, .max = 1000},
            "straight segments that approximate the curved faces of a voussoir");
}

void declare_wall(Section& s, WallSurface& wall) {
  s.number("length", wall.length, {.unit = "m", .above = 0}, "dimension along x");
  expect_length(s, "length", wall.length, 0.05, 1e3);
  s.number("height", wall.height, {.unit = "m", .above = 0}, "dimension along z");
  expect_length(s, "height", wall.height);
  declare_shell_thickness(s, wall.thickness, kThickest, "dimension along y");
}

}  // namespace

void declare_surface(Section& s, Surface& surface) {
  s.variant<Surface>(
      "type", surface,
      {alternative<Surface>("dome", "dome of revolution, two arcs", declare_dome),
       alternative<Surface>("octagonal_vault", "cloister vault of cylindrical sails over a regular polygon",
                            declare_octagonal_vault),
       alternative<Surface>("arch", "arch or barrel vault of two arcs", declare_arch),
       alternative<Surface>("wall", "plane wall", declare_wall),
       alternative<Surface>("vault", "any profile along any plan", declare_vault)},
      "shape of the masonry");
}

namespace {

void declare_grid(Section& s, int& rings, int& blocks_per_ring, int& refine) {
  s.integer("rings", rings, {.min = 1, .max = kMostRings},
            "number of rings of a dome, courses of a wall, or voussoirs of an arch");
  s.integer("blocks_per_ring", blocks_per_ring, {.min = 1, .max = kMostCells},
            "number of whole blocks in each ring; at least 3 on a closed ring");
  s.integer(
      "refine", refine, {.min = 1, .max = 1000},
      "split each course into this many courses and each block into this many blocks, in the same bond");
}

/// `slices`: cells per whole block along the ring.
template <class SomeBond>
void check_cells(const Section& s, const SomeBond& bond, double slices) {
  const double courses = 1.0 * bond.rings * bond.refine;
  s.rule(courses <= kMostRings, "refine", "rings x refine must be <= 1e5; reduce one of them");
  s.rule(courses * bond.blocks_per_ring * bond.refine * slices <= kMostCells, "blocks_per_ring",
         "rings x blocks_per_ring x slices x refine^2 must be <= 2e7 cells; reduce one of them");
}

constexpr const char* kPhase = "block widths from the first corner to the first head joint or spiral";
constexpr const char* kNoPhase = "joints avoid corners";

void declare_running_bond(Section& s, RunningBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 2, .max = 64},
            "convex cells per block along the ring; an even number");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  s.rule(bond.slices_per_block % 2 == 0, "slices_per_block",
         "must be even, because odd rings are shifted by half a block");
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
  s.integer("spirals", bond.spirals, {.min = 1, .max = kMostRings},
            "number of spirals, or of meridian strips");
  s.integer("rings_per_vertical", bond.rings_per_vertical, {.min = 1, .max = 1000},
            "height of an upright block, in rings");
  s.integer("verticals_per_block", bond.verticals_per_block, {.min = 1, .max = 1000},
            "width of a whole block over the width of an upright block");
  s.choice("path", bond.path, "upright blocks climb in spirals or straight up the meridians");
  s.choice(
      "chirality", bond.chirality,
      "right: spirals climb counter-clockwise, seen from above; both: spirals of either hand, which cross");
  s.integer(
      "embedment", bond.embedment, {.min = -1},
      "courses by which the uprights in the last course built stand in the courses below, one upright per "
      "spiral and course; -1: a new one in each course, so that uprights of every embedment stand side by "
      "side");
  s.rule(bond.embedment < bond.rings_per_vertical, "embedment", "must be < rings_per_vertical");
  s.rule(bond.embedment < 0 || bond.refine == 1, "embedment", "requires refine: 1");
  s.choice("beside", bond.beside,
           "head joints of the flat blocks: step with the spirals, keep a half bond, or lie on meridians");
  s.optional_number("phase", bond.phase, {.min = 0, .below = 1}, kNoPhase, kPhase);
  s.integer("slices_per_vertical", bond.slices_per_vertical, {.min = 1, .max = 64},
            "convex cells per upright block along the ring");
  s.rule(bond.beside != HerringboneBond::Beside::half ||
             bond.verticals_per_block * bond.slices_per_vertical % 2 == 0,
         "beside",
         "half requires an even number of slices per block; change verticals_per_block or "
         "slices_per_vertical so that their product is even");
  check_cells(s, bond, 1.0 * bond.verticals_per_block * bond.slices_per_vertical);
}

void declare_fill_bond(Section& s, FillBond& bond) {
  declare_grid(s, bond.rings, bond.blocks_per_ring, bond.refine);
  s.integer("slices_per_block", bond.slices_per_block, {.min = 1, .max = 64},
            "number of positions per mean block width where a head joint may lie");
  s.number("narrowest", bond.narrowest, {.above = 0, .max = 1},
           "width of the narrowest block over the mean width");
  s.number("widest", bond.widest, {.min = 1, .max = 10}, "width of the widest block over the mean width");
  check_cells(s, bond, bond.slices_per_block);
}

void declare_drawn_bond(Section& s, DrawnBond& bond) {
  s.integer("rings", bond.rings, {.min = 1, .max = kMostRings}, "number of courses");
  s.texts("rows", bond.rows,
          "the drawing, seen from outside, the uppermost course first: cells of one letter that touch form a "
          "block, a point is empty");
  s.required_number("letter_length", bond.letter_length, {.unit = "m", .above = 0},
                    "length of a letter along the first bed, on the intrados");
  s.integer("shift", bond.shift, {.min = -100000, .max = 100000},
            "letters by which the drawing moves along where it is repeated above itself");
  s.optional_number("phase", bond.phase, {.min = 0, .max = 100000}, kNoPhase,
                    "letters from the first corner, or the end of a wall, to the drawing");
  s.integer(
      "refine", bond.refine, {.min = 1, .max = 1000},
      "split each course into this many courses and each block into this many blocks, in the same bond");
  s.rule(!bond.rows.empty() && !bond.rows.front().empty(), "rows",
         "is missing: give the rows of the drawing, for example [aaaabbbb, ccddddcc]");
  size_t cells = 0;
  for (size_t i = 0; i < bond.rows.size(); ++i) {
    const std::string& row = bond.rows[i];
    cells += row.size();
    s.rule(row.size() == bond.rows.front().size(), "rows",
           fmt::format("all rows must have the same number of letters: row {} has {}, the first {}", i,
                       row.size(), bond.rows.front().size()));
    s.rule(std::ranges::all_of(row, [](char c) { return c > ' ' && c <= '~'; }), "rows",
           fmt::format("row {} has a blank or a letter outside ASCII", i));
  }
  s.rule(cells <= kMostCells / 20, "rows", "a drawing has at most 1e6 letters");
}

}  // namespace

void declare_bond(Section& s, Bond& bond) {
  s.variant<Bond>(
      "type", bond,
      {alternative<Bond>("running", "running bond: odd rings shifted by half a block", declare_running_bond),
       alternative<Bond>("stack", "stack bond: head joints aligned", declare_stack_bond),
       alternative<Bond>("herringbone",
                         "herringbone bond: upright blocks climb through whole blocks laid flat",
                         declare_herringbone_bond),
       alternative<Bond>("fill", "blocks of unequal width whose head joints avoid those of the ring below",
                         declare_fill_bond),
       alternative<Bond>("drawn", "a bond drawn in letters, repeated over the surface", declare_drawn_bond)},
      "how the shell is cut into blocks");
}

namespace {

void declare_window(Section& s, Window& window) {
  s.required_number(
      "height", window.height, {.unit = "m", .above = 0},
      "height above the springing of the bed under the last course built, on the intrados at a corner");
  s.number("course", window.course, {.unit = "m", .above = 0},
           "height of the courses, measured along the intrados at a corner");
  s.number("from_deg", window.from_deg, {.unit = "deg", .min = -360, .max = 360}, "azimuth of one end");
  s.number("to_deg", window.to_deg, {.unit = "deg", .min = -360, .max = 720},
           "azimuth of the other end, counter-clockwise seen from above");
  s.choice("ends", window.ends, "free, or held by fixed masonry as if the rest of the ring were built");
  const double sector = window.to_deg - window.from_deg;
  s.rule(sector > 0 && sector <= 360, "to_deg", "must be above from_deg, by at most 360");
  s.rule(window.ends == Window::Ends::free || sector < 360, "ends", "held requires a sector below 360 deg");
}

void declare_affine(Section& s, Affine& affine) {
  s.vector3("scale", affine.scale, {.above = 0}, "factors along x, y and z");
  s.number("rake", affine.rake, {}, "rise along the axis of a barrel, per length");
}

void declare_chain(Section& s, Chain& chain) {
  s.text("name", chain.name, "name in tables and figures; by default its number");
  s.choice("type", chain.type,
           "polygon: straight bars between anchors in the masonry; clamps: a bar across each head joint");
  s.integer("course", chain.course, {.min = -1, .max = kMostRings},
            "course in whose middle the chain lies; -1: at height");
  s.optional_number("height", chain.height, {.unit = "m"}, "that of the course",
                    "height of the chain above the springing, instead of a course");
  s.number("place", chain.place, {.above = 0, .below = 1},
           "place in the thickness, from 0 at the intrados to 1 at the extrados");
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
  const bool polygon = chain.type == Chain::Type::polygon;
  s.rule((chain.course >= 0) != chain.height.has_value(), "course",
         "a chain has either a course or a height");
  s.rule(polygon || chain.links == 0, "links", "requires type: polygon");
  s.rule(polygon || chain.course >= 0, "height", "clamps require a course");
  s.rule(!polygon || chain.clamp_length == Chain{}.clamp_length, "clamp_length", "requires type: clamps");
  s.rule(chain.links == 0 || chain.links >= 3, "links", "must be 0 or at least 3");
  s.rule(chain.long_blocks == 0 || (chain.long_blocks >= 3 && chain.course >= 0), "long_blocks",
         "requires a course, and at least 3 blocks");
  s.rule(chain.slack == 0.0 || chain.prestress == 0.0, "slack", "a chain has either slack or prestress");
  s.rule(!chain.yield_force || chain.prestress <= *chain.yield_force, "prestress", "must be <= yield_force");
}

void declare_stage(Section& s, Stage& stage) {
  s.required_integer("rings", stage.rings, {.min = 1, .max = kMostRings}, "number of rings built so far");
}

void declare_block_density(Section& s, BlockDensity& change) {
  s.texts("blocks", change.blocks, "names of the blocks");
  s.required_number("density", change.density, {.unit = "kg/m3", .above = 0}, "density of these blocks");
  s.expect({"density", change.density, "kg/m3", kLightest / 9.81, kHeaviest / 9.81,
            "in t/m3 or kN/m3? Write 1800", "a unit weight in N/m3? Divide by 9.81"});
}

void declare_import(Section& s, ImportedBlocks& import) {
  s.file("file", import.path, "file, or folder of files, with the blocks to import", true);
  s.choice("format", import.format,
           "format of the file; automatic: chosen by the file name extension (.json: compas, .csv and .txt: "
           "bricks)");
  s.optional_number("metres_per_unit", import.metres_per_unit, {.unit = "m", .above = 0}, "1",
                    "length of the file's unit in metres; required if the model would be larger than 1 km or "
                    "smaller than 50 mm");
  s.choice("up", import.up, "axis of the file that points upward");
  s.texts("supports", import.supports, "names of the blocks to fix");
  s.flag("flagged_supports", import.flagged_supports, "fix the blocks that the file marks as fixed");
  s.optional_number("fixed_below", import.fixed_below, {.unit = "m"}, "none",
                    "fix the blocks whose centroid lies below this height");
  s.choice("fixed_by", import.fixed_by,
           "fix the blocks with a corner in the lowest plane of the model, or those with a single neighbour");
  s.optional_vector3("axis", import.axis, {.unit = "m"}, "through the centroid of the supports",
                     "a point of the vertical axis from which `outward` points");
  s.list("densities", import.densities, "densities of particular blocks", declare_block_density);
  s.file("springs", import.springs, "file of springs that carry tension only (brick CSV)");
  s.file("rods", import.rods, "file of rigid rods (brick CSV)");
  s.optional_number(
      "facet_angle", import.facet_angle, {.unit = "rad", .above = 0, .max = 0.1}, "from the data",
      "merge neighbouring triangles whose normals differ by less than this into one plane facet");
  s.optional_number("snap", import.snap, {.unit = "m", .min = 0}, "from the data",
                    "move facing facets closer than this into a common plane; 0: leave them");
  s.retired("weld",
            "remove it: vertices closer than 1e-6 of the block size are merged; let the program that made "
            "the file merge others");
  s.retired("most_overlap", "contact.margin is the largest overlap, in all programs");
  s.retired("joint_gap", "contact.margin is the largest gap of a joint, in all programs");
}

}  // namespace

void declare_geometry(Section& s, Geometry& geometry) {
  s.optional_section("import", geometry.imported, "import blocks cut elsewhere, instead of surface and bond",
                     declare_import);
  if (geometry.imported) return;
  s.retired("drum", "give it as one of geometry.members, and `on: drum` for the dome (docs/cases.md)");
  geometry.has_shell = !s.gives("members") || s.gives("surface");
  if (geometry.has_shell) {
    declare_shape(s, geometry);
  } else {
    for (const char* key : {"on", "at", "bond", "wythes", "bonders", "openings"})
      s.refuse(
          key,
          "remove this key: geometry has no surface of its own, and each of geometry.members has this key");
  }
  s.list("members", geometry.members, "further walls, drums and vaults, or all of them", declare_member);
  check_members(s, geometry);
  s.optional_section("affine", geometry.affine, "stretch or shear the finished masonry", declare_affine);
  s.optional_section(
      "window", geometry.window,
      "cut only some courses over a sector of the shell; bond.rings and bond.blocks_per_ring are "
      "counted in it",
      declare_window);
  s.optional_section("stage", geometry.stage, "build only the lower rings", declare_stage);
  s.list("chains", geometry.chains, "closed chains of iron, stone or timber round a dome or vault",
         declare_chain);
  for (size_t i = 0; i < geometry.chains.size(); ++i)
    if (geometry.chains[i].name.empty()) geometry.chains[i].name = fmt::format("chain {}", i);
  s.number("support_width", geometry.support_width, {.unit = "m", .above = 0},
           "distance by which the fixed base extends beyond the shell");
  s.integer(
      "base_blocks", geometry.base_blocks, {.min = 1, .max = 1000},
      "equal fixed blocks into which the base of a dome or vault is divided, so that one may settle; the "
      "first lies about the first corner");

  const Member& member = last_member(geometry);
  const bool closed = traits_of(member.surface).closed;
  const int rings = std::visit([](const auto& bond) { return bond.rings; }, *finest_bond(member));
  s.rule(!geometry.stage || geometry.stage->rings <= rings, "stage", "stage.rings must be <= bond.rings");
  s.rule(!geometry.window || (closed && members_of(geometry).size() == 1), "window",
         "requires a dome or an octagonal vault, and no members");
  const bool has_copies =
      std::ranges::any_of(members_of(geometry), [](const Member* m) { return m->copies.has_value(); });
  s.rule(!has_copies || (!geometry.window && !geometry.stage && geometry.chains.empty()), "chains",
         "chains, stage and window require members without copies");
  if (!geometry.window && geometry.has_shell) check_closed_bonds(s, geometry);
  const bool whole = !geometry.window && closed;
  s.rule(geometry.chains.empty() || whole, "chains", "requires a whole dome or octagonal vault");
  s.rule(!geometry.affine || !geometry.window, "affine", "requires a whole vault without a window");
  s.rule(!geometry.affine || geometry.affine->rake == 0.0 || !closed, "affine",
         "rake requires an arch or barrel, whose first bed stays plane");
  s.rule(geometry.base_blocks == 1 || whole, "base_blocks", "requires a whole dome or octagonal vault");
  for (const Chain& chain : geometry.chains)
    s.rule(chain.course < rings, "chains", "course must be < bond.rings");
  for (const Chain& chain : geometry.chains)
    s.rule(chain.long_blocks == 0 || member.wythes.empty(), "chains",
           "long_blocks requires a shell without wythes");
}

void declare_imperfections(Section& s, Imperfections& imperfections) {
  s.number("gap", imperfections.gap, {.unit = "m", .min = 0}, "open the joints by random amounts up to this");
  s.number("noise", imperfections.noise, {.unit = "m", .min = 0},
           "move faces and corners by random amounts up to this; joints stay closed");
  for (const auto& [key, value] : {std::pair("gap", imperfections.gap), {"noise", imperfections.noise}})
    s.expect({key, value, "m", 0.0, 0.05, "", kMillimetres});
  s.integer("seed", imperfections.seed, {.min = 0}, "seed of the random numbers");
}

}  // namespace cupola
