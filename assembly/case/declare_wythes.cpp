#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

constexpr NumberRule kWytheThickness{.unit = "m", .above = 0};

void declare_thickness_points(Section& s, Thickness& thickness) {
  thickness.values.clear();
  s.numbers("heights", thickness.heights, {.unit = "m", .min = 0}, "heights above the springing, ascending");
  s.numbers("values", thickness.values, kWytheThickness, "thickness at each height, linear in between");
  s.rule(std::ranges::adjacent_find(thickness.heights, std::greater_equal<>()) == thickness.heights.end(),
         "heights", "must ascend");
  s.rule(thickness.heights.size() >= 2 && thickness.values.size() == thickness.heights.size(), "values",
         "requires two heights or more and one value for each");
}

void declare_height_range(Section& s, HeightRange& where, const std::string& what) {
  s.number("from_height", where.from, {.unit = "m", .min = 0}, "height above the springing where " + what);
  s.optional_number("to_height", where.to, {.unit = "m", .above = 0}, "the top", "height where they end");
  s.rule(!where.to || *where.to > where.from, "to_height", "must be above from_height");
}

void declare_wythe(Section& s, Wythe& wythe) {
  s.text("name", wythe.name, "name of the wythe in tables and in bonders");
  s.rule(!wythe.name.empty(), "name", "is missing: give each wythe a name");
  s.required_number_or_section("thickness", wythe.thickness.values.front(), kWytheThickness, wythe.thickness,
                               "thickness of the wythe", declare_thickness_points);
  for (const double value : wythe.thickness.values)
    s.expect({"thickness", value, "m", kThinnest, kThickest, kKilometres, kMillimetres});
  s.optional_section("bond", wythe.bond,
                     "pattern in which the wythe is cut into blocks; without it the wythe is a cavity, empty "
                     "where no bonder crosses it",
                     declare_bond);
  declare_height_range(s, wythe.where, "its courses begin");
}

void declare_bonders(Section& s, Bonders& bonders) {
  s.text("name", bonders.name, "name of these blocks in tables");
  s.rule(!bonders.name.empty(), "name", "is missing: give each group of bonders a name");
  s.text("from", bonders.from, "innermost wythe that the blocks occupy");
  s.text("to", bonders.to, "outermost wythe that the blocks occupy");
  s.integer("per_ring", bonders.per_ring, {.min = 1, .max = 1000000},
            "number of blocks in a course at each position of `at`; they are equally spaced");
  s.numbers("at", bonders.at, {.min = 0, .below = 1},
            "middles of the blocks, in spacings from the first corner or the end of the wall");
  s.number("width", bonders.width, {.above = 0, .max = 1},
           "width of a block over the spacing; 1: a closed course");
  s.number("shift", bonders.shift, {.min = 0, .below = 1},
           "spacings by which every other of these courses is moved along the course");
  s.integer("every", bonders.every, {.min = 1}, "courses from one course with these blocks to the next");
  s.integer("first", bonders.first, {.min = 0},
            "courses of the height range below the first of these courses");
  declare_height_range(s, bonders.where, "they begin");
}

/// Position of a wythe in the list, or -1.
int index_of(const std::vector<Wythe>& wythes, const std::string& name) {
  const auto found = std::ranges::find(wythes, name, &Wythe::name);
  return found == wythes.end() ? -1 : static_cast<int>(found - wythes.begin());
}

/// All wythes share the beds of the one with the most courses.
void check_courses(const Section& s, const Masonry& masonry) {
  const int most = rings_of(*finest_bond(masonry));
  for (const Wythe& wythe : masonry.wythes)
    if (wythe.bond)
      s.rule(most % rings_of(*wythe.bond) == 0, "wythes",
             fmt::format("{} has {} courses, which do not divide the {} of the wythe with the most",
                         wythe.name, rings_of(*wythe.bond), most));
}

}  // namespace

void declare_masonry(Section& s, Masonry& masonry) {
  std::vector<Wythe>& wythes = masonry.wythes;
  std::vector<Bonders>& bonders = masonry.bonders;
  if (s.gives("wythes"))
    s.refuse("bond", "remove this key: `wythes` gives the bond of each wythe");
  else
    s.section("bond", masonry.bond, "pattern in which the shell is cut into blocks", declare_bond);
  s.list("wythes", wythes, "layers through the thickness, inside first, instead of a thickness and a bond",
         declare_wythe);
  s.list("bonders", bonders, "blocks through several wythes: headers, ribs, solid courses", declare_bonders);
  if (!s.gives("wythes")) {
    s.rule(bonders.empty(), "bonders", "requires wythes");
    return;
  }
  s.rule(!bonds_of(masonry).empty() && !wythes.empty(), "wythes", "at least one wythe must have a bond");
  for (size_t i = 0; i < wythes.size(); ++i)
    s.rule(index_of(wythes, wythes[i].name) == static_cast<int>(i), "wythes",
           fmt::format("two wythes are called {}", wythes[i].name));
  for (const Bonders& group : bonders) {
    const int from = index_of(wythes, group.from), to = index_of(wythes, group.to);
    s.rule(from >= 0 && to >= from, "bonders",
           fmt::format("{}: from `{}` to `{}` must be names of wythes, the inner one first", group.name,
                       group.from, group.to));
  }
  check_courses(s, masonry);
}

}  // namespace cupola
