#include <algorithm>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

using Order = StagedConstruction::Order;
using Unit = StagedConstruction::Unit;

void declare_mortar_compliance(Section& s, FreshMortar& fresh) {
  s.optional_number("normal", fresh.normal, {.unit = "m/N, m3/N", .min = 0}, "as hardened",
                    "normal compliance of fresh joints");
  s.optional_number("tangential", fresh.tangential, {.unit = "m/N, m3/N", .min = 0}, "as hardened",
                    "tangential compliance of fresh joints");
}

void declare_fresh(Section& s, FreshMortar& fresh) {
  s.integer("courses", fresh.courses, {.min = 1}, "courses laid last whose bed joints are fresh");
  s.flag("heads", fresh.heads, "their head joints are fresh too");
  s.number("friction", fresh.friction, {.min = 0}, "friction coefficient of fresh joints");
  s.number("cohesion", fresh.cohesion, {.unit = "Pa", .min = 0}, "cohesion of fresh joints");
  s.number("tension", fresh.tension, {.unit = "Pa", .min = 0},
           "tensile strength of fresh joints; ends at cohesion / friction");
  s.section("compliance", fresh,
            "elastic displacement of fresh joints under force; hardening keeps their forces",
            declare_mortar_compliance);
}

void declare_curing(Section& s, CuringMortar& mortar) {
  s.required_number("age", mortar.age, {.min = 0}, "courses laid since, or days if days_per_course is given");
  s.optional_number("friction", mortar.law.friction, {.min = 0}, "hardened", "friction coefficient");
  s.optional_number("cohesion", mortar.law.cohesion, {.unit = "Pa", .min = 0}, "hardened", "cohesion");
  s.optional_number("tension", mortar.law.tension, {.unit = "Pa", .min = 0}, "hardened", "tensile strength");
  s.optional_number("normal", mortar.law.normal, {.unit = "m/N, m3/N", .min = 0}, "hardened",
                    "normal compliance");
  s.optional_number("tangential", mortar.law.tangential, {.unit = "m/N, m3/N", .min = 0}, "hardened",
                    "tangential compliance");
}

bool same_keys(const JointLawChange& a, const JointLawChange& b) {
  return a.friction.has_value() == b.friction.has_value() &&
         a.cohesion.has_value() == b.cohesion.has_value() && a.tension.has_value() == b.tension.has_value() &&
         a.normal.has_value() == b.normal.has_value() && a.tangential.has_value() == b.tangential.has_value();
}

void declare_curing_rules(Section& s, const StagedConstruction& staged) {
  for (size_t i = 1; i < staged.curing.size(); ++i) {
    s.rule(staged.curing[i - 1].age < staged.curing[i].age, "curing", "ages must increase from row to row");
    s.rule(same_keys(staged.curing[i - 1].law, staged.curing[i].law), "curing",
           "every row must give the same properties");
  }
  using enum StagedConstruction::Least;
  const auto& front =
      staged.curing.empty() ? JointLawChange{0.0, {}, {}, {}, 0.0, {}, {}} : staged.curing[0].law;
  s.rule((staged.least != friction || front.friction) && (staged.least != cohesion || front.cohesion),
         "least", "requires a property that curing gives; the value found is that of its first row");
  s.rule(!staged.days_per_course || !staged.curing.empty(), "days_per_course", "requires curing");
}

}  // namespace

void declare_staged(Section& s, StagedConstruction& staged) {
  s.choice("unit", staged.unit, "what a stage lays: a course (ring), or one block of every team (block)");
  s.integer(
      "teams", staged.teams, {.min = 1, .max = 100000},
      "unit: block: equal parts of a course that are laid at the same time, one block of each per stage");
  s.choice(
      "order", staged.order,
      "unit: block: direction of laying along the course, seen from above; alternating: counterclockwise in "
      "even courses; given: by sequence");
  s.blocks("sequence", staged.sequence,
           "order: given: blocks in the order in which those of a course are laid; others follow");
  s.flag("carry", staged.carry,
         "each stage starts from displacements, forces, slip and damage of the last one; a new block is laid "
         "stress-free");
  s.integer("first_ring", staged.first_ring, {.min = 0},
            "last ring laid in the first stage computed; the rings below are laid at once");
  s.integer("last_ring", staged.last_ring, {.min = -1},
            "last ring laid in the last stage computed; -1: the complete model");
  std::optional<double> short_form;
  s.optional_number("fresh_friction", short_form, {.min = 0}, "as fresh.friction",
                    "short form of fresh.friction");
  staged.fresh.friction = short_form.value_or(staged.fresh.friction);
  s.section("fresh", staged.fresh, "mortar of the joints laid last", declare_fresh);
  s.rule(!short_form || *short_form == staged.fresh.friction, "fresh_friction",
         "is the short form of fresh.friction, which has another value; give one of them");
  s.list("curing", staged.curing,
         "mortar by age, instead of the values of fresh; interpolated linearly, hardened beyond the last row",
         declare_curing);
  s.optional_number("days_per_course", staged.days_per_course, {.unit = "days", .above = 0},
                    "ages count courses", "ages in curing are in days, of which a course takes this many");
  s.integer("hold_below", staged.hold_below, {.min = -1},
            "courses below the one being laid that are solved with it; lower ones are supports; -1: all are "
            "solved");
  s.flag("allow_associated", staged.allow_associated,
         "unit: block: accept friction laws under which open courses jam");
  s.retired("critical_friction", "give least: friction instead of true, and nothing instead of false");
  s.choice("least", staged.least,
           "property of fresh mortar whose least value is found with which each stage stands");
  s.number("relative_width", staged.relative_width, {.above = 0, .below = 1},
           "relative width of the final bracket of least");
  declare_curing_rules(s, staged);
  s.rule(staged.order != Order::given || !staged.sequence.empty(), "order", "given requires a sequence");
  s.rule(staged.order == Order::given || staged.sequence.empty(), "sequence", "requires order: given");
  s.rule(staged.unit == Unit::block || staged.order == Order::counterclockwise, "order",
         "requires unit: block");
  s.rule(staged.unit == Unit::block || staged.teams == 1, "teams", "requires unit: block");
}

}  // namespace cupola
