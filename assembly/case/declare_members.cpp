#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
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
  s.required_number("width", openings.width, {.unit = "m", .above = 0},
                    "width on the inner face, at the sill");
  s.required_number("height", openings.height, {.unit = "m", .above = 0}, "height of the opening");
  s.required_number("sill", openings.sill, {.unit = "m", .min = 0},
                    "height of its lower edge above the springing of the member");
  s.number("lintel", openings.lintel, {.unit = "m", .min = 0},
           "height of the block that covers the opening; 0: one course");
  s.number("bearing", openings.bearing, {.unit = "m", .above = 0},
           "length on which the lintel rests beyond each side of the opening, on the inner face");
}

void declare_along(Section& s, Cut& cut) {
  s.choice("axis", cut.axis, "direction of the body: its outline lies in the other two coordinates");
  s.optional_number("from", cut.from, {.unit = "m"}, "without end", "where it begins along its axis");
  s.optional_number("to", cut.to, {.unit = "m"}, "without end", "where it ends along its axis");
  s.rule(!cut.from || !cut.to || *cut.from < *cut.to, "to", "must be above from");
}

void declare_plane_cut(Section& s, Cut& cut) {
  cut.kind = Cut::Kind::plane;
  s.vector3("point", cut.point, {}, "point of the plane");
  s.vector3("normal", cut.normal, {}, "direction into what is taken away");
  s.rule(cut.normal.norm() > 0.0, "normal", "must not be zero");
  s.choice(
      "as", cut.as,
      "what lies behind the faces of the cut: nothing, a fixed support, the rest of the stones, parted by a "
      "joint, or another member, which loses what lies on this side");
  s.text("member", cut.member, "of a mitre: the member behind the plane");
  s.rule((cut.as == Cut::As::mitre) != cut.member.empty(), "member",
         "belongs to as: mitre, and only there: the name of the member behind the plane");
}

void declare_prism_cut(Section& s, Cut& cut) {
  cut.kind = Cut::Kind::prism;
  declare_along(s, cut);
  s.numbers("u", cut.u, {.unit = "m"}, "corners of the convex outline: y of an axis x, else x");
  s.numbers("v", cut.v, {.unit = "m"}, "their z, or y of an axis z");
  const size_t n = cut.u.size();
  s.rule(n >= 3 && n == cut.v.size(), "u", "u and v must have the same number of corners, at least 3");
  double turning = 0.0;  // rad; all turns of a closed outline amount to 2 pi if it is convex, else to more
  for (size_t i = 0; i < n && n == cut.v.size(); ++i) {
    const size_t j = (i + 1) % n, k = (i + 2) % n;
    const Eigen::Vector2d side(cut.u[j] - cut.u[i], cut.v[j] - cut.v[i]),
        next(cut.u[k] - cut.u[j], cut.v[k] - cut.v[j]);
    s.rule(side.norm() > 0.0, "u", fmt::format("corners {} and {} coincide, counted from 0", i, j));
    turning += std::abs(std::atan2(side.x() * next.y() - side.y() * next.x(), side.dot(next)));
  }
  s.rule(turning < 2.0 * std::numbers::pi + 1e-9, "u",
         "the outline must be convex: give an outline with re-entrant corners as several cuts");
}

void declare_cylinder_cut(Section& s, Cut& cut) {
  cut.kind = Cut::Kind::cylinder;
  declare_along(s, cut);
  s.number("centre_u", cut.centre_u, {.unit = "m"}, "y of an axis x, else x");
  s.number("centre_v", cut.centre_v, {.unit = "m"}, "z, or y of an axis z");
  s.number("radius", cut.radius, {.unit = "m", .above = 0}, "radius of its corners");
  s.integer("sides", cut.sides, {.min = 3, .max = 1000}, "number of its plane sides");
}

void declare_under_cut(Section& s, Cut& cut) {
  cut.kind = Cut::Kind::under;
  s.text("member", cut.member, "a barrel of the case");
  s.choice("face", cut.face,
           "of that member: what lies under it, from end to end and downwards, is taken away");
  s.rule(!cut.member.empty(), "member", "is missing: give the name of a member");
}

void declare_over_cut(Section& s, Cut& cut) {
  cut.kind = Cut::Kind::over;
  s.text("member", cut.member, "a groin vault of the case: what lies over its intrados is taken away");
  s.rule(!cut.member.empty(), "member", "is missing: give the name of a member");
}

void declare_cut(Section& s, Cut& cut) {
  s.variant<Cut>(
      "type", cut,
      {{"plane", "all on one side of a plane", declare_plane_cut},
       {"prism", "a door, a window, a sector: a prism over a convex polygon", declare_prism_cut},
       {"cylinder", "a round window: a prism over a regular polygon", declare_cylinder_cut},
       {"under", "a lunette: what lies under another barrel", declare_under_cut},
       {"over", "the back of a rib: what lies over the intrados of a groin vault", declare_over_cut}},
      "body that is taken away");
}

void declare_place(Section& s, Place& place) {
  s.vector3("origin", place.origin, {}, "point to which the origin of the member moves");
  s.number("rotate_deg", place.rotate_deg, {.unit = "deg", .min = -360, .max = 360},
           "turn about the vertical through it, counter-clockwise seen from above");
}

void declare_affine(Section& s, Affine& affine) {
  s.vector3("scale", affine.scale, {.above = 0}, "factors along x, y and z");
  s.number("lean", affine.lean, {}, "move along the axis of a barrel, per height: its arches lean");
  s.number("rake", affine.rake, {}, "rise along the axis of a barrel, per length");
}

void check_affine(const Section& s, const std::optional<Affine>& affine, const Surface& surface) {
  s.rule(!affine || (affine->rake == 0.0 && affine->lean == 0.0) || !traits_of(surface).closed, "affine",
         "lean and rake require an arch or barrel; a leaning tower stands upright under a tilted "
         "loads.gravity");
}

/// True if a course can be a closed ring. The letters of a drawing are counted where it is laid.
template <class SomeBond>
bool has_ring(const SomeBond& bond) {
  return bond.blocks_per_ring >= 3;
}
bool has_ring(const DrawnBond& /*bond*/) {
  return true;
}

void declare_copies(Section& s, Copies& copies) {
  s.integer("count", copies.count, {.min = 0, .max = 1000}, "number of them, with the member itself");
  s.optional_vector3("about", copies.about, {.unit = "m"}, "none",
                     "they stand at equal angles round the vertical through this point");
  s.vector3("by", copies.by, {.unit = "m"}, "move from one to the next");
  s.list("at", copies.at, "where each of the others stands, in place of count", declare_place);
  s.rule(int{copies.about.has_value()} + int{copies.by.norm() > 0.0} + int{!copies.at.empty()} == 1, "about",
         "give one of about, by and at");
  s.rule(copies.at.empty() ? copies.count >= 2 : copies.count == 0, "count",
         copies.at.empty() ? "must be at least 2" : "the places in `at` are counted; remove this key");
}

void declare_beside(Section& s, Beside& beside) {
  s.text("member", beside.member, "a member before it in the list, or one of its copies: NAME 2");
  s.choice("side", beside.side, "its side on which this one stands, along its own axes");
  s.rule(!beside.member.empty(), "member", "is missing: give the name of a member");
}

void declare_mirror(Section& s, Mirror& mirror) {
  s.vector3("point", mirror.point, {.unit = "m"}, "point of the plane");
  s.vector3("normal", mirror.normal, {}, "normal of the plane");
  s.rule(mirror.normal.z() == 0.0 && mirror.normal.norm() > 0.0, "normal",
         "must be horizontal, and not zero");
}

/// `at` of a member beside another: along the side it would change nothing.
void check_place_beside(const Section& s, const Member& member) {
  if (!member.at || !member.beside) return;
  using enum Beside::Side;
  const bool along_x = member.beside->side == right || member.beside->side == left;
  s.rule(member.at->origin[along_x ? 0 : 1] == 0.0, "at",
         fmt::format("origin counts from that of {}, and its {} is fixed by `beside`: write 0",
                     member.beside->member, along_x ? "x" : "y"));
}

}  // namespace

void check_closed_bonds(const Section& s, const Member& member) {
  for (const Bond* bond : bonds_of(member))
    s.rule(!traits_of(member.surface).closed || std::visit([](const auto& b) { return has_ring(b); }, *bond),
           member.wythes.empty() ? "bond" : "wythes", "bond.blocks_per_ring must be >= 3 on a closed ring");
}

void declare_member(Section& s, Member& member) {
  member.name.clear();
  s.text("name", member.name, "name in tables and for `on`");
  s.rule(!member.name.empty(), "name", "is missing: give each member a name");
  declare_shape(s, member);
  check_closed_bonds(s, member);
}

void declare_shape(Section& s, Member& member) {
  s.text("on", member.on, "member on whose last bed this one stands; without it, on supports of its own");
  s.optional_section("beside", member.beside,
                     "member next to which this one stands, up to a common vertical plane", declare_beside);
  s.optional_section(
      "at", member.at,
      "where the member stands, by default at the origin, or at that of `beside`; with `on`, where a groin "
      "vault or an arch stands on several copies of a member",
      declare_place);
  check_place_beside(s, member);
  s.rule(!member.beside || member.on.empty(), "beside",
         fmt::format("a member that stands on {0} lies on its axis: leave out `beside`, and give {0} a place "
                     "`at` which this one touches {1}",
                     member.on, member.beside ? member.beside->member : ""));
  s.rule(
      member.on.empty() || !member.at || member.at->origin.z() == 0.0, "at",
      fmt::format("the height of origin is fixed by on: {}: write 0, or, unless this is an arch or a groin "
                  "vault, leave out `at`",
                  member.on));
  s.optional_section("copies", member.copies,
                     "equal copies of the member, and of the members that stand on it: NAME 2, NAME 3, ...",
                     declare_copies);
  s.rule(!member.copies || member.begins_stack(), "copies",
         fmt::format("a member that stands on {} is copied with it: give `copies` there; one that stands on "
                     "several of its copies has `at`",
                     member.on));
  s.optional_section("mirror", member.mirror,
                     "a mirror image of the member, and of the members that stand on it: NAME 2",
                     declare_mirror);
  s.rule(!member.mirror || (member.on.empty() && !member.copies), "mirror",
         "requires a member without `on` and `copies`");
  s.section("surface", member.surface, "shape of the masonry", declare_surface);
  declare_affine_of(s, member);
  declare_masonry(s, member);
  s.list("openings", member.openings, "windows in a closed member, each under a lintel in one block",
         declare_openings);
  s.list("cuts", member.cuts, "convex bodies that are taken away, in coordinates of the member before `at`",
         declare_cut);
}

void declare_affine_of(Section& s, Member& member) {
  s.optional_section(
      "affine", member.affine,
      "stretch or shear the finished masonry; that of the geometry acts on all members without",
      declare_affine);
  check_affine(s, member.affine, member.surface);
}

void check_members(const Section& s, const Geometry& geometry) {
  const std::vector<const Member*> members = members_of(geometry);
  for (size_t i = 0; i < members.size(); ++i) {
    const std::string &name = members[i]->name, &on = members[i]->on;
    const std::string key = members[i] == &geometry ? "on" : "members";
    for (size_t k = 0; k < i; ++k)
      s.rule(members[k]->name != name, "members", fmt::format("two members are called {}", name));
    const bool is_before = i > 0 && members[i - 1]->name == on;
    const bool is_earlier = std::any_of(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(i),
                                        [&](const Member* member) { return member->name == on; });
    s.rule(on.empty() || is_before || (members[i]->at && is_earlier), key,
           fmt::format("{} must be {} {} in the list{}", on,
                       members[i]->at ? "a member before" : "the member before", name,
                       i > 0 && !members[i]->at ? ", which is " + members[i - 1]->name : ""));
    check_affine(s, affine_of(geometry, *members[i]), members[i]->surface);
    s.rule(!geometry.affine || !geometry.has_shell || !members[i]->copies || members[i]->affine, "affine",
           fmt::format("would act on each copy of {} along its own axes: give that member an `affine` of its "
                       "own, {{scale: [1, 1, 1]}} to leave it as it is",
                       name));
  }
}

}  // namespace cupola
