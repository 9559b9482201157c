#include "generators/stereotomy/shell.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/bond/long_blocks.hpp"
#include "generators/bond/make_bond.hpp"
#include "generators/bond/wythe_bond.hpp"
#include "generators/stereotomy/meetings.hpp"
#include "generators/stereotomy/opening_places.hpp"
#include "generators/stereotomy/placement.hpp"
#include "generators/surface/make_surface.hpp"
#include "generators/surface/window.hpp"

namespace cupola {
namespace {

/// Adds the supports of a window: a row below the first, and with held ends a slice beyond each end.
BondPattern with_supports(const BondPattern& bond, double held_end) {
  const int beyond = held_end > 0.0 ? 1 : 0;  // slices
  BondPattern out;
  out.num_rings = bond.num_rings + 1;
  out.num_wythes = bond.num_wythes;
  if (beyond > 0) out.cuts.push_back(-held_end);
  out.cuts.insert(out.cuts.end(), bond.cuts.begin(), bond.cuts.end());
  if (beyond > 0) out.cuts.push_back(bond.cuts.back() + held_end);
  out.blocks = bond.blocks;
  const int base = static_cast<int>(out.blocks.size()), last = out.num_slices() - 1;
  out.blocks.resize(out.blocks.size() + 1 + 2 * static_cast<size_t>(beyond), {BlockKind::support, false, -1});
  for (int row = 0; row < out.num_rings; ++row)
    for (int slice = 0; slice <= last; ++slice)
      for (int wythe = 0; wythe < out.num_wythes; ++wythe) {
        const bool at_end = beyond > 0 && (slice == 0 || slice == last);
        out.block_of.push_back(at_end     ? base + (slice == 0 ? 1 : 2)
                               : row == 0 ? base
                                          : bond.at(row - 1, slice - beyond, wythe));
      }
  return out;
}

/// Maps all points of a surface. Heights change with them, depths do not.
void apply(const Affine& affine, SurfaceMap* surface) {
  surface->at = [affine, at = surface->at](double bed, double abscissa, double depth) -> Vec3 {
    return affine.image(at(bed, abscissa, depth));
  };
  surface->springing = affine.image(surface->springing);
  if (surface->shell_volume) *surface->shell_volume *= affine.scale.prod();
}

/// m above the springing, of the middle of each course.
std::vector<double> course_heights(const SurfaceMap& surface) {
  std::vector<double> heights;
  for (int ring = 0; ring < surface.num_rings(); ++ring)
    heights.push_back(surface.height((ring - surface.first_ring() + 0.5) * surface.rows_per_ring));
  return heights;
}

/// m, of a bed, on the intrados.
double length_of_bed(const SurfaceMap& surface, double bed) {
  constexpr int kSteps = 1000;  // beside the corners; the chords of a circle are 2e-6 too short
  std::vector<double> abscissae = surface.corners;
  for (int i = 0; i <= kSteps; ++i) abscissae.push_back(surface.extent * i / kSteps);
  std::ranges::sort(abscissae);
  double length = 0.0;
  for (size_t i = 1; i < abscissae.size(); ++i)
    length += (surface.intrados(bed, abscissae[i]) - surface.intrados(bed, abscissae[i - 1])).norm();
  return length;
}

/// m, between the beds of the first course, on the intrados.
double thickness_of_first_course(const SurfaceMap& surface) {
  const double first = surface.first_row_held ? 1.0 : 0.0;
  return (surface.intrados(first + surface.rows_per_ring, surface.first_corner) -
          surface.intrados(first, surface.first_corner))
      .norm();
}

std::vector<Thickness> thicknesses(const std::vector<Wythe>& wythes) {
  std::vector<Thickness> out;
  for (const Wythe& wythe : wythes) out.push_back(wythe.thickness);
  return out;
}

BondPattern lay_masonry(const Masonry& masonry, const SurfaceMap& surface, const BondGrid& grid) {
  return masonry.wythes.empty() ? make_bond(masonry.bond, grid)
                                : make_wythe_bond(masonry, grid, course_heights(surface));
}

/// Names of what lays blocks. In a model of several members, the wythes of all but the last carry the name of
/// their member.
std::vector<std::string> names_of(const Geometry& geometry, const Member& member) {
  std::vector<std::string> names = member_names(member);
  if (&member != &last_member(geometry))
    for (std::string& name : names) name = member.name + " " + name;
  const bool alone =
      members_of(geometry).size() == 1 && !member.copies && !member.mirror && member.openings.empty();
  if (names.empty() && !alone) names = {member.name};
  return names;
}

void lay_chains(const Geometry& geometry, const Member& member, const BondGrid& grid, int refinement,
                BondPattern* bond) {
  for (size_t c = 0; c < geometry.chains.size(); ++c)
    if (const Chain& chain = geometry.chains[c];
        chain.long_blocks > 0 && member_named(geometry, chain.member) == &member)
      lay_long_blocks(grid, chain.course * refinement, (chain.course + 1) * refinement - 1, chain.long_blocks,
                      fmt::format("geometry.chains[{}]", c), bond);
}

/// True if the letters of a bond keep their length in courses that shorten. Throws InputError where they do
/// not shorten, and for what requires joints in the same places in all courses.
bool has_constant_length(const Geometry& geometry, const Member& member, bool closed) {
  const auto is_constant = [](const Bond* bond) {
    const auto* drawn = std::get_if<DrawnBond>(bond);
    return drawn && drawn->length == DrawnBond::Length::constant;
  };
  if (std::ranges::none_of(bonds_of(member), is_constant)) return false;
  const auto refuse = [](bool given, const char* what) {
    if (given) throw InputError(fmt::format("geometry.bond.length = constant: {}", what));
  };
  refuse(!closed, "the courses of an open surface have one length; remove this key");
  refuse(!member.wythes.empty(), "not available for wythes; give the shell one bond");
  refuse(!member.openings.empty(), "not available with openings; cut windows by `cuts`");
  refuse(geometry.window.has_value(), "not available with geometry.window; remove one of them");
  for (const Chain& chain : geometry.chains)
    refuse(chain.long_blocks > 0 && member_named(geometry, chain.member) == &member,
           "not available with long_blocks of a chain; remove one of them");
  return true;
}

/// A member in its own coordinates, as if it stood alone.
Storey make_member(const Geometry& geometry, const Member& member, const std::string& key) {
  const bool last = &member == &last_member(geometry);
  const Bond& bond_of_courses = *finest_bond(member);
  const int courses = rings_of(bond_of_courses), refinement = refinement_of(bond_of_courses);
  const int stage = last && geometry.stage ? geometry.stage->rings * refinement : 0;
  SurfaceMap surface = geometry.window
                           ? window_surface(member.surface, thicknesses(member.wythes), *geometry.window,
                                            courses, stage > 0 ? stage : courses, geometry.support_width)
                           : make_surface(member.surface, courses, thicknesses(member.wythes));
  if (stage > 0 && surface.key_stone) surface.carries = false;  // the stone is to come
  const SurfaceMap before_affine = surface;
  const std::optional<Affine>& affine = affine_of(geometry, member);
  if (affine && surface.webs == 0) apply(*affine, &surface);
  if (surface.webs > 0 && stage > 0)
    throw InputError("geometry.stage: not available for a groin vault; remove this section");
  if (surface.webs > 0 && geometry.imperfections && geometry.imperfections->of_shape())
    throw InputError("imperfections: gap and noise are not available for a groin vault; remove them");
  BondGrid grid{surface.num_rings(),
                surface.closed,
                surface.extent,
                surface.corners,
                geometry.window.has_value(),
                stage,
                length_of_bed(surface, 0),
                thickness_of_first_course(surface)};
  if (has_constant_length(geometry, member, surface.closed)) {
    grid.round = !surface.flat_slices;
    for (int ring = 0; ring < surface.num_rings(); ++ring)
      grid.lengths.push_back(length_of_bed(surface, ring * surface.rows_per_ring));
  }
  BondPattern bond = lay_masonry(member, surface, grid);
  if (grid.round) {
    surface = faceted(before_affine, bond.cuts_of(0));
    if (affine) apply(*affine, &surface);
  }
  std::vector<std::string> names = names_of(geometry, member);
  lay_chains(geometry, member, grid, refinement, &bond);
  if (!member.openings.empty()) {
    lay_openings(grid, opening_places(member.openings, surface, key + ".openings"),
                 static_cast<int>(names.size()), &bond);
    names.push_back(member.name + " lintel");
  }
  if (geometry.window) bond = with_supports(bond, surface.held_end);
  return {member.name, std::move(surface), std::move(bond), std::move(names), stage, refinement};
}

/// Bonds and surfaces do not know where they are laid, and their errors name keys of the geometry itself.
Storey named_member(const Geometry& geometry, size_t i) {
  const Member& member = *members_of(geometry)[i];
  const std::string key = key_of_member(geometry, i);
  if (&member == &geometry) return make_member(geometry, member, key);
  try {
    return make_member(geometry, member, key);
  } catch (const InputError& error) {
    std::string text = error.what(), of_geometry = "geometry.";
    text.erase(0, text.find(' ') + 1);  // "error: "
    if (text.starts_with(of_geometry) && !text.starts_with(key))
      text.replace(0, of_geometry.size(), key + ".");
    throw InputError(text.starts_with(key) ? text : key + ": " + text);
  }
}

}  // namespace

std::vector<Storey> make_storeys(const Geometry& geometry) {
  const std::vector<const Member*> members = members_of(geometry);
  std::vector<Storey> storeys;
  std::map<std::string, size_t> bearer;  // by member: the first of its stack
  size_t first = 0;                      // of the stack, member and storey
  size_t first_storey = 0;
  for (size_t i = 0; i < members.size(); ++i) {
    Storey storey = named_member(geometry, i);
    storey.cuts = members[i]->cuts;
    if (storey.surface.webs > 0) storey.affine = affine_of(geometry, *members[i]);
    storey.key = key_of_member(geometry, i);
    if (members[i]->at) storey.placement = placement_at(*members[i]->at);
    if (members[i]->on.empty()) {
      if (i > 0) copy_stack(*members[first], first_storey, &storeys);
      if (members[i]->beside) stand_beside(*members[i]->beside, storey.key, storeys, &storey);
    } else {
      const Storey& lower = *std::ranges::find(storeys, members[i]->on, &Storey::name);
      stand_on(storey.key, *members[bearer.at(members[i]->on)], *members[i], lower, &storey);
      for (Storey& copy : storeys)
        if (copy.key == lower.key) copy.surface.carries = copy.bears_another = true;
      if (!storey.stands_on_previous) copy_stack(*members[first], first_storey, &storeys);
    }
    if (!storeys.empty())
      storey.surface.rings_below = storeys.back().surface.rings_below + storeys.back().num_rings();
    if (!storey.stands_on_previous) {  // a stack begins, perhaps on several others
      first = i;
      first_storey = storeys.size();
    }
    bearer[members[i]->name] = first;
    storeys.push_back(std::move(storey));
  }
  copy_stack(*members[first], first_storey, &storeys);
  limit_neighbours(&storeys);
  pair_mitres(&storeys);
  return storeys;
}

}  // namespace cupola
