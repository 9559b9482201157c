#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

constexpr double kStandardGravity = 9.81;  // m/s2, as Material::density

void declare_compliance(Section& s, Compliance& compliance) {
  s.choice("per", compliance.per, {{"point", Compliance::Per::point}, {"area", Compliance::Per::area}},
           "what the compliance belongs to: each contact point (m/N) or the joint's area (m3/N)",
           {.required = true});
  s.number("normal", compliance.normal, {.unit = "m/N, m3/N", .min = 0}, "yield along the normal");
  s.number("tangential", compliance.tangential, {.unit = "m/N, m3/N", .min = 0}, "yield along the joint");
}

}  // namespace

void declare_material(Section& s, Material& material) {
  s.quantity(
      material.unit_weight,
      {{"unit_weight", 1.0, {.unit = "N/m3", .above = 0}, "weight per volume"},
       {"density", kStandardGravity, {.unit = "kg/m3", .above = 0}, "mass per volume, times 9.81 m/s2"}});
}

void declare_joints(Section& s, Joints& joints) {
  s.number("friction", joints.friction, {.min = 0}, "Coulomb friction coefficient mu");
  s.section("compliance", joints.compliance, "how far joints yield under force", declare_compliance);
  s.later({"bed", "head", "herringbone", "base", "rings"});
}

}  // namespace cupola
