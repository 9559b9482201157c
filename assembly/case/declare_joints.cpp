#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

constexpr double kStandardGravity = 9.81;  // m/s2, as Material::density

/// Of all times.
double least_factor(const TimeFunction& function) {
  double least = factor_at(function, 0.0);
  for (double time = next_corner(function, 0.0); time <= seen_by(function);
       time = next_corner(function, time))
    least = std::min(least, factor_at(function, time));
  return least;
}

/// How to choose, with the defaults.
std::string advice_per() {
  const Compliance point = Compliance::default_per(Compliance::Per::point),
                   area = Compliance::default_per(Compliance::Per::area);
  return fmt::format(
      "choose point (normal and tangential in m/N for each contact point, as in the paper, by default {:g} "
      "and {:g}) or area (in m3/N, independent of the number of contact points, by default {:g} and {:g})",
      point.normal, point.tangential, area.normal, area.tangential);
}

void expect_friction(const Section& s, double friction) {
  s.expect({"friction", friction, "", 0.0, 3.0, "", "an angle in degrees? The coefficient is its tangent"});
}

void expect_strength(const Section& s, const char* key, double strength) {
  if (strength != 0.0 && !std::isinf(strength))
    s.expect({key, strength, "Pa", 50.0, 1e9, "in MPa or kPa? Strengths are in Pa: 2.5 MPa is 2.5e6",
              "too many digits? Stone carries up to 3e8 Pa"});
}

/// Joints that are too soft are found by what they do (solver/dynamics/joints_on_supports.hpp). Zero: rigid.
void expect_compliance(const Section& s, const std::string& key, double compliance, Compliance::Per per) {
  if (compliance == 0.0) return;
  const bool area = per == Compliance::Per::area;
  s.expect({key, compliance, area ? "m3/N" : "m/N", 1e-17, area ? 1e-6 : 1e-5,
            "too small for double precision to matter? 0 makes joints rigid",
            area ? "a stiffness, or in mm3/N? Compliance is its reciprocal, such as 1e-10 m3/N"
                 : "a stiffness, or in mm/N? Compliance is its reciprocal, such as 1e-8 m/N"});
}

/// True if the section is left out or relative.
bool declare_relative_compliance(Section& s, Compliance& compliance) {
  const NumberRule rule{.above = 0};
  std::optional<double> relative;
  s.optional_number(
      "relative", relative, rule, fmt::format("{:g} if the section is left out", Compliance::kRelative),
      "closing of a joint under the mean weight of a block on the square of its size, over that size; "
      "stands alone, per area");
  if (!relative && !s.is_empty()) return false;
  for (const char* key : {"per", "normal", "tangential"})
    s.refuse(key, "`relative` stands alone: leave out either it or per, normal and tangential");
  if (!relative) s.settled_number("relative", Compliance::kRelative, rule);
  const double unknown = std::numeric_limits<double>::quiet_NaN();  // until the blocks are
  compliance = {unknown, unknown, Compliance::Per::area, relative.value_or(Compliance::kRelative)};
  s.expect({"relative", *compliance.relative, "", 1e-12, 0.01,
            "too small for double precision to matter? Compliances of 0 make joints rigid",
            "in percent? It is the closing of a joint over the size of a block"});
  return true;
}

void declare_compliance(Section& s, Compliance& compliance) {
  if (declare_relative_compliance(s, compliance)) return;
  s.required_choice("per", compliance.per, "compliance per contact point (m/N) or per area of joint (m3/N)",
                    advice_per());
  compliance = Compliance::default_per(compliance.per);
  const auto defaults = [](double Compliance::*value) {
    return fmt::format("{:g} per point, {:g} per area",
                       Compliance::default_per(Compliance::Per::point).*value,
                       Compliance::default_per(Compliance::Per::area).*value);
  };
  s.number("normal", compliance.normal, {.unit = "m/N, m3/N", .min = 0},
           "normal displacement per unit force; 0 counts as 1e-4 of the tangential one",
           defaults(&Compliance::normal));
  s.number("tangential", compliance.tangential, {.unit = "m/N, m3/N", .min = 0},
           "tangential displacement per unit force; 0 counts as 1e-4 of the normal one",
           defaults(&Compliance::tangential));
  expect_compliance(s, "normal", compliance.normal, compliance.per);
  expect_compliance(s, "tangential", compliance.tangential, compliance.per);
}

void declare_fracture_energy(Section& s, FractureEnergy& energy) {
  s.required_number("tension", energy.tension, {.unit = "N/m", .above = 0},
                    "work per area that opens a crack until it carries no tension");
  s.required_number("shear", energy.shear, {.unit = "N/m", .above = 0},
                    "work per area that shears a crack until it has no cohesion, without that of friction");
  for (const auto& [key, value] : {std::pair("tension", energy.tension), {"shear", energy.shear}})
    s.expect({key, value, "N/m", 0.1, 1e5, "in N/mm? 0.02 N/mm is 20 N/m",
              "too many digits? Mortar joints break with 1 to 500 N/m"});
}

void declare_law_change(Section& s, JointLawChange& law) {
  s.optional_number("friction", law.friction, {.min = 0}, "as elsewhere",
                    "friction coefficient of these joints");
  s.optional_number("normal", law.normal, {.unit = "m/N, m3/N", .min = 0}, "as elsewhere",
                    "normal compliance of these joints");
  s.optional_number("tangential", law.tangential, {.unit = "m/N, m3/N", .min = 0}, "as elsewhere",
                    "tangential compliance of these joints");
  s.optional_number("tension", law.tension, {.unit = "Pa", .min = 0}, "as elsewhere",
                    "tensile strength of these joints");
  s.optional_number("cohesion", law.cohesion, {.unit = "Pa", .min = 0}, "as elsewhere",
                    "cohesion of these joints");
  s.optional_number("compressive_strength", law.compressive_strength, {.unit = "Pa", .above = 0},
                    "as elsewhere", "compressive strength of these joints");
  if (law.friction) expect_friction(s, *law.friction);
  expect_strength(s, "tension", law.tension.value_or(0.0));
  expect_strength(s, "cohesion", law.cohesion.value_or(0.0));
  expect_strength(s, "compressive_strength", law.compressive_strength.value_or(0.0));
  s.optional_section("fracture_energy", law.fracture_energy, "fracture energy of these joints",
                     declare_fracture_energy);
}

void declare_ring_joints(Section& s, RingJoints& joints) {
  declare_joint_group(s, joints);
  declare_law_change(s, joints.law);
}

void declare_field(Section& s, JointField& field) {
  s.integer("seed", field.seed, {.min = 0}, "seed of the random numbers");
  s.required_number("correlation_length", field.correlation_length, {.unit = "m", .above = 0},
                    "distance over which the logarithm of a factor has the correlation 1/e");
  s.number("friction", field.friction, {.min = 0, .max = 1}, "coefficient of variation of the friction");
  s.number("strength", field.strength, {.min = 0, .max = 1},
           "coefficient of variation of tension, cohesion and compressive strength, which vary together");
  s.number("compliance", field.compliance, {.min = 0, .max = 1},
           "coefficient of variation of the compliance");
}

void declare_failure_rules(Section& s, const Joints& joints) {
  const bool softens = joints.failure == JointFailure::softening;
  const bool energies =
      joints.fracture_energy ||
      std::ranges::any_of(joints.kinds(),
                          [](const auto& kind) { return kind.second->fracture_energy.has_value(); }) ||
      std::ranges::any_of(joints.rings,
                          [](const RingJoints& group) { return group.law.fracture_energy.has_value(); });
  // Limits require plastic joints, also of a case that extends one whose joints soften.
  const bool says_plastic = joints.failure == JointFailure::plastic && s.gives("failure");
  s.rule(softens || says_plastic || !energies, "fracture_energy",
         "requires joints.failure: softening, or that it is given as plastic");
  s.rule(!softens || joints.fracture_energy, "failure",
         "softening requires fracture_energy: {tension: N/m, shear: N/m}");
  s.rule(joints.failure == JointFailure::plastic || joints.have_strength(), "failure",
         "brittle and softening require joints with tension or cohesion");
}

}  // namespace

void declare_joint_group(Section& s, RingJoints& joints) {
  s.required_integer("from", joints.from, {.min = 0},
                     "lowest ring; a joint belongs to the ring of its upper block");
  joints.to = joints.from;
  s.integer("to", joints.to, {.min = 0}, "highest ring; default: the same as from");
  s.choice(
      "kind", joints.sort,
      "which joints of these rings; other: those that are neither bed nor head of courses, nor of any kind "
      "that a key of `joints` names, as a springer's with the side of its pier; laid_bed: every bed, "
      "including those on supports and of herringbone blocks; laid_head: every head, including those of "
      "herringbone blocks");
  s.rule(joints.from <= joints.to, "to", "must be >= from");
}

void declare_material(Section& s, Material& material) {
  s.quantity(material.unit_weight,
             {{"unit_weight", 1.0, {.unit = "N/m3", .above = 0}, "weight per unit volume"},
              {"density",
               kStandardGravity,
               {.unit = "kg/m3", .above = 0},
               "mass per unit volume, converted with 9.81 m/s2"}});
  s.expect({"unit_weight", material.unit_weight, "N/m3", kLightest, kHeaviest,
            "in kN/m3, or a density in kg/m3? Write 18000, or density: 1800",
            "too many digits? Stone and brick weigh 15000 to 30000 N/m3"});
}

void declare_joints(Section& s, Joints& joints) {
  s.number("friction", joints.friction, {.min = 0}, "Coulomb friction coefficient mu");
  expect_friction(s, joints.friction);
  s.section("compliance", joints.compliance, "elastic displacement of the joints under force",
            declare_compliance);
  JointStrength& strength = joints.strength;
  s.number("tension", strength.tension, {.unit = "Pa", .min = 0},
           "tensile strength per area of joint; ends at cohesion / friction");
  s.number("cohesion", strength.cohesion, {.unit = "Pa", .min = 0},
           "shear strength per area of joint without normal force: shear <= cohesion + friction x pressure");
  std::optional<double> compression;
  s.optional_number("compressive_strength", compression, {.unit = "Pa", .above = 0}, "none",
                    "largest pressure in a joint");
  strength.compression = compression.value_or(strength.compression);
  expect_strength(s, "tension", strength.tension);
  expect_strength(s, "cohesion", strength.cohesion);
  expect_strength(s, "compressive_strength", strength.compression);
  s.choice("failure", joints.failure,
           "where tension or cohesion is exceeded: plastic keeps them, brittle loses both at once, softening "
           "loses them gradually by fracture_energy");
  s.optional_section("fracture_energy", joints.fracture_energy,
                     "softening: work per area that breaks a joint", declare_fracture_energy);
  s.optional_section("bed", joints.bed, "joints between rings", declare_law_change);
  s.optional_section("head", joints.head, "joints within a ring", declare_law_change);
  s.optional_section("herringbone", joints.herringbone, "joints that touch a herringbone block",
                     declare_law_change);
  s.optional_section("base", joints.base, "joints with a fixed support", declare_law_change);
  s.optional_section("wythe", joints.wythe, "joints between layers of the thickness", declare_law_change);
  s.optional_section(
      "pieces", joints.pieces,
      "joints between pieces of one imported block, named NAME#1, NAME#2, ...: where it can crack",
      declare_law_change);
  s.list("rings", joints.rings, "joint laws of particular rings; the last entry that matches a joint applies",
         declare_ring_joints);
  const auto expect_compliances = [&](const std::string& group, const JointLawChange& law) {
    expect_compliance(s, group + ".normal", law.normal.value_or(0.0), joints.compliance.per);
    expect_compliance(s, group + ".tangential", law.tangential.value_or(0.0), joints.compliance.per);
  };
  for (const auto& [key, law] : joints.kinds()) expect_compliances(key, *law);
  for (size_t i = 0; i < joints.rings.size(); ++i)
    expect_compliances(fmt::format("rings[{}]", i), joints.rings[i].law);
  s.optional_section("field", joints.field,
                     "random factors on the values of joints, as functions of place with mean 1",
                     declare_field);
  s.rule(!joints.field || joints.field->strength == 0.0 || joints.have_strength(), "field",
         "strength: has no effect on joints without tension, cohesion and compressive_strength");
  declare_time(s, "friction_time", joints.friction_time, "factor on every friction coefficient");
  s.rule(least_factor(joints.friction_time) >= 0.0, "friction_time",
         "must not fall below 0, as a harmonic does in half of its time; give a table");
  const char* key = strength.tension > 0.0        ? "tension"
                    : strength.cohesion > 0.0     ? "cohesion"
                    : strength != JointStrength{} ? "compressive_strength"
                                                  : "compliance";
  s.rule(!joints.have_strength() || joints.compliance.per == Compliance::Per::area, key,
         "tension, cohesion and compressive_strength require compliance: {per: area}, because only then a "
         "contact point stands for an area of joint");
  declare_failure_rules(s, joints);
}

}  // namespace cupola
