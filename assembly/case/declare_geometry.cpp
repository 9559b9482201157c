#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

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

void declare_stage(Section& s, Stage& stage) {
  s.required_integer("rings", stage.rings, {.min = 1, .max = kMostRings}, "number of rings built so far");
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
    for (const char* key :
         {"on", "beside", "at", "copies", "mirror", "bond", "wythes", "bonders", "openings", "cuts"})
      s.refuse(
          key,
          "remove this key: geometry has no surface of its own, and each of geometry.members has this key");
    declare_affine_of(s, geometry);
  }
  s.list("members", geometry.members, "further walls, drums and vaults, or all of them", declare_member);
  check_members(s, geometry);
  s.optional_section(
      "window", geometry.window,
      "cut only some courses over a sector of the shell; bond.rings and bond.blocks_per_ring are "
      "counted in it",
      declare_window);
  s.optional_section("stage", geometry.stage, "build only the lower rings, of a barrel from both springings",
                     declare_stage);
  s.list("chains", geometry.chains, "chains round a dome or vault, and tie rods across a barrel",
         declare_chain);
  for (size_t i = 0; i < geometry.chains.size(); ++i)
    if (geometry.chains[i].name.empty()) geometry.chains[i].name = fmt::format("chain {}", i);
  s.number(
      "support_width", geometry.support_width, {.unit = "m", .above = 0},
      "distance by which the fixed base extends beyond the shell, at most half-way to the stones on that of "
      "another member");
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
      std::ranges::any_of(members_of(geometry), [](const Member* m) { return m->copies || m->mirror; });
  s.rule(!has_copies || (!geometry.window && !geometry.stage), "stage",
         "stage and window require members without copies");
  if (!geometry.window && geometry.has_shell) check_closed_bonds(s, geometry);
  const bool whole = !geometry.window && closed;
  s.rule(geometry.chains.empty() || !geometry.window, "chains", "requires a whole vault without a window");
  s.rule(!geometry.affine || !geometry.window, "affine", "requires a whole vault without a window");
  s.rule(geometry.base_blocks == 1 || whole, "base_blocks", "requires a whole dome or octagonal vault");
  for (const Chain& chain : geometry.chains) check_chain(s, geometry, chain);
}

void declare_imperfections(Section& s, Imperfections& imperfections) {
  s.number("gap", imperfections.gap, {.unit = "m", .min = 0}, "open the joints by random amounts up to this");
  s.number(
      "noise", imperfections.noise, {.unit = "m", .min = 0},
      "move each bed, head and skin by random amounts up to this, a corner by those of the three that meet "
      "there; joints stay closed");
  for (const auto& [key, value] : {std::pair("gap", imperfections.gap), {"noise", imperfections.noise}})
    s.expect({key, value, "m", 0.0, 0.05, "", kMillimetres});
  s.integer("seed", imperfections.seed, {.min = 0}, "seed of the random numbers");
  s.optional_number("correlation_length", imperfections.correlation_length, {.unit = "m", .above = 0},
                    "gaps and noise are independent numbers",
                    "gaps, noise and density are functions of place, correlated by 1/e over this distance");
  s.number("density", imperfections.density, {.min = 0, .max = 1},
           "coefficient of variation of the density of free blocks");
  s.rule(imperfections.density == 0.0 || imperfections.correlation_length, "density",
         "requires correlation_length: the density is a function of place");
  s.rule(!imperfections.correlation_length || imperfections.of_shape() || imperfections.density > 0.0,
         "correlation_length", "has no effect without gap, noise or density");
}

}  // namespace cupola
