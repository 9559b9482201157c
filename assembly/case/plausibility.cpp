#include "assembly/case/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/variant.hpp"
#include "assembly/case/plausible_range.hpp"
#include "assembly/files/time_table.hpp"

namespace cupola {
namespace {

constexpr const char* kRadians = "in radians? Keys that end in _deg are in degrees";

/// A length of the structure, m.
PlausibleRange length(const std::string& key, double value, double low, double high) {
  return {"surface." + key, value, "m", low, high, "in kilometres? Lengths are in m", kMillimetres};
}

/// An angle of a vault, deg. Angles in radians are at most pi.
PlausibleRange vault_angle(const std::string& key, double value) {
  return {"surface." + key, value, "deg", 4.0, 180.0, kRadians, ""};
}

/// With wythes the thickness of the surface is not in use.
std::vector<PlausibleRange> wythe_checks(const std::vector<Wythe>& wythes, const std::string& where) {
  std::vector<PlausibleRange> checks;
  for (size_t i = 0; i < wythes.size(); ++i)
    for (const double value : wythes[i].thickness.values)
      checks.push_back({fmt::format("{}.wythes[{}].thickness", where, i), value, "m", 0.002, 20.0,
                        "in kilometres? Lengths are in m", kMillimetres});
  return checks;
}

std::vector<PlausibleRange> surface_checks(const Surface& surface) {
  constexpr double kNarrowest = 0.05, kWidest = 250.0, kThinnest = 0.002, kThickest = 20.0;
  const auto shell = [&](double span, double thickness) {
    return std::vector{length("span", span, kNarrowest, kWidest),
                       length("thickness", thickness, kThinnest, std::min(kThickest, 0.5 * span))};
  };
  const auto and_angle = [](std::vector<PlausibleRange> checks, const std::string& key, double angle) {
    checks.push_back(vault_angle(key, angle));
    return checks;
  };
  return std::visit(
      Overloaded{[&](const DomeSurface& s) {
                   return and_angle(shell(s.span, s.thickness), "crown_angle_deg", s.crown_angle_deg);
                 },
                 [&](const OctagonalVault& s) {
                   return and_angle(shell(s.span, s.thickness), "crown_angle_deg", s.crown_angle_deg);
                 },
                 [&](const ArchSurface& s) {
                   std::vector<PlausibleRange> checks =
                       and_angle(shell(s.span, s.thickness), "half_embrace_deg", s.half_embrace_deg);
                   checks.push_back(length("width", s.width, kThinnest, kWidest));
                   return checks;
                 },
                 [&](const VaultSurface& s) {
                   return std::vector{length("profile.span", s.profile.width(), kNarrowest, kWidest),
                                      length("thickness", s.thickness, kThinnest, kThickest)};
                 },
                 [&](const WallSurface& s) {
                   return std::vector{length("length", s.length, kNarrowest, 1e3),
                                      length("height", s.height, kNarrowest, kWidest),
                                      length("thickness", s.thickness, kThinnest, kThickest)};
                 }},
      surface);
}

/// Weights from aerated concrete to steel.
std::vector<PlausibleRange> material_checks(const Case& scene) {
  constexpr double kLightest = 3e3, kHeaviest = 8e4;  // N/m3
  std::vector<PlausibleRange> checks{{"material.unit_weight", scene.material.unit_weight, "N/m3", kLightest,
                                      kHeaviest,
                                      "in kN/m3, or a density in kg/m3? Write 18000, or density: 1800",
                                      "too many digits? Stone and brick weigh 15000 to 30000 N/m3"}};
  if (scene.geometry.imported)
    for (size_t i = 0; i < scene.geometry.imported->densities.size(); ++i)
      checks.push_back({fmt::format("geometry.import.densities[{}].density", i),
                        scene.geometry.imported->densities[i].density, "kg/m3", kLightest / 9.81,
                        kHeaviest / 9.81, "in t/m3 or kN/m3? Write 1800",
                        "a unit weight in N/m3? Divide by 9.81"});
  if (const auto& imperfections = scene.geometry.imperfections)
    for (const auto& [key, value] :
         {std::pair("gap", imperfections->gap), std::pair("noise", imperfections->noise)})
      checks.push_back({fmt::format("imperfections.{}", key), value, "m", 0.0, 0.05, "", kMillimetres});
  return checks;
}

/// Friction coefficients and compliances, of all joints and of those with a law of their own. Joints that are
/// too soft are found by what they do (solver/dynamics/soft_joints.hpp).
void add_joint_checks(const Joints& joints, std::vector<PlausibleRange>* checks) {
  const bool area = joints.compliance.per == Compliance::Per::area;
  const auto friction = [checks](const std::string& key, double value) {
    checks->push_back(
        {key + "friction", value, "", 0.0, 3.0, "", "an angle in degrees? The coefficient is its tangent"});
  };
  const auto compliance = [checks, area](const std::string& key, double value) {
    if (value == 0.0) return;  // rigid
    checks->push_back({key, value, area ? "m3/N" : "m/N", 1e-17, area ? 1e-6 : 1e-5,
                       "too small for double precision to matter? 0 makes joints rigid",
                       area ? "a stiffness, or in mm3/N? Compliance is its reciprocal, such as 1e-10 m3/N"
                            : "a stiffness, or in mm/N? Compliance is its reciprocal, such as 1e-8 m/N"});
  };
  const auto strength = [checks](const std::string& key, double value) {
    if (value == 0.0 || std::isinf(value)) return;
    checks->push_back({key, value, "Pa", 50.0, 1e9, "in MPa or kPa? Strengths are in Pa: 2.5 MPa is 2.5e6",
                       "too many digits? Stone carries up to 3e8 Pa"});
  };
  const auto energy = [checks](const std::string& key, const std::optional<FractureEnergy>& energies) {
    if (!energies) return;
    for (const auto& [mode, value] :
         {std::pair("tension", energies->tension), std::pair("shear", energies->shear)})
      checks->push_back({fmt::format("{}fracture_energy.{}", key, mode), value, "N/m", 0.1, 1e5,
                         "in N/mm? 0.02 N/mm is 20 N/m",
                         "too many digits? Mortar joints break with 1 to 500 N/m"});
  };
  const auto change = [&](const std::string& key, const JointLawChange& law) {
    energy(key, law.fracture_energy);
    strength(key + "tension", law.tension.value_or(0.0));
    strength(key + "cohesion", law.cohesion.value_or(0.0));
    strength(key + "compressive_strength", law.compressive_strength.value_or(0.0));
    if (law.friction) friction(key, *law.friction);
    if (law.normal) compliance(key + "normal", *law.normal);
    if (law.tangential) compliance(key + "tangential", *law.tangential);
  };
  friction("joints.", joints.friction);
  strength("joints.tension", joints.strength.tension);
  strength("joints.cohesion", joints.strength.cohesion);
  strength("joints.compressive_strength", joints.strength.compression);
  energy("joints.", joints.fracture_energy);
  compliance("joints.compliance.normal", joints.compliance.normal);
  compliance("joints.compliance.tangential", joints.compliance.tangential);
  for (const auto& [key, law] : joints.kinds()) change(fmt::format("joints.{}.", key), *law);
  for (size_t i = 0; i < joints.rings.size(); ++i)
    change(fmt::format("joints.rings[{}].", i), joints.rings[i].law);
}

void add_load_checks(const Case& scene, std::vector<PlausibleRange>* checks) {
  const Loads& loads = scene.loads;
  if (const double g = loads.gravity.norm(); g > 0.0)
    checks->push_back({"loads.gravity (its length)", g, "m/s2", 1.5, 1500.0,
                       "a multiple of g? Gravity is in m/s2", "in mm/s2? Gravity is in m/s2"});
  checks->push_back({"loads.gravity (z)", loads.gravity.z(), "m/s2", kNoLowerEnd, 0.0, "",
                     "upward? The z axis points up, so that gravity is [0, 0, -9.81]"});
  if (loads.lantern)
    checks->push_back({"loads.lantern.weight_fraction", loads.lantern->weight_fraction, "of the weight", 0.0,
                       1.0, "", "in per cent? 2 % is 0.02"});
  // Under `load` the forces are unit loads, which the analysis multiplies.
  const bool unit_loads = scene.analysis.type == AnalysisType::limit &&
                          scene.analysis.limit.parameter == LimitSearch::Parameter::load;
  for (size_t i = 0; i < loads.faces.size() && !unit_loads; ++i)
    for (const auto& [key, value] : {std::pair("traction", loads.faces[i].traction.norm()),
                                     std::pair("pressure", std::abs(loads.faces[i].pressure))})
      if (value > 0.0)
        checks->push_back({fmt::format("loads.faces[{}].{}", i, key), value, "N/m2", 5.0, 1e8,
                           "in kN/m2? Loads are in N/m2", "too many digits? 1e6 N/m2 is 1 MPa"});
  for (size_t i = 0; i < scene.ties.pairs.size(); ++i)
    checks->push_back({fmt::format("ties.pairs[{}].stiffness", i), scene.ties.pairs[i].stiffness, "N/m", 1e3,
                       1e12, "in kN/mm? 1 kN/mm is 1e6 N/m",
                       "a modulus in N/m2? Stiffness is modulus times section over length"});
  for (size_t i = 0; i < scene.geometry.chains.size(); ++i) {
    const Chain& chain = scene.geometry.chains[i];
    checks->push_back({fmt::format("geometry.chains[{}].axial_stiffness", i), chain.axial_stiffness, "N", 1e5,
                       1e12, "in kN? 1 kN is 1000 N", "a modulus in N/m2? It is modulus times section"});
    if (chain.yield_force)
      checks->push_back({fmt::format("geometry.chains[{}].yield_force", i), *chain.yield_force, "N", 1e3,
                         1e10, "in kN? 1 kN is 1000 N", "a strength in N/m2? It is strength times section"});
  }
}

void add_analysis_checks(const Case& scene, std::vector<PlausibleRange>* checks) {
  const Analysis& analysis = scene.analysis;
  if (analysis.type == AnalysisType::dynamic)
    checks->push_back({"analysis.time_step", analysis.time_step, "s", 1e-7, 0.5,
                       "too many zeros? Steps are in s", "in ms? Steps are in s"});
  if (analysis.type == AnalysisType::limit && analysis.limit.parameter == LimitSearch::Parameter::tilt)
    checks->push_back({"analysis.limit.high", analysis.limit.high, "deg", std::numbers::pi / 2, 90.0,
                       kRadians, "a wall that leans by more than 90 deg lies"});
  if (analysis.type == AnalysisType::limit &&
      analysis.limit.parameter == LimitSearch::Parameter::acceleration)
    checks->push_back({"analysis.limit.high", analysis.limit.high, "g", 0.0, 5.0, "",
                       "in m/s2? The horizontal acceleration is a multiple of g"});
  if (!scene.supports.base_motion) return;
  const BaseMotion& motion = *scene.supports.base_motion;
  double peak = 0.0;
  for (const double value : read_time_table(motion.file).values) peak = std::max(peak, std::abs(value));
  peak *= motion.direction.norm();
  if (motion.quantity == BaseMotion::Quantity::acceleration)
    checks->push_back({"supports.base_motion (largest acceleration)", peak, "m/s2", 0.1, 50.0,
                       "in g? Multiply direction by 9.81", "in cm/s2 (gal)? Multiply direction by 0.01"});
  else
    checks->push_back({"supports.base_motion (largest displacement)", peak, "m", 1e-5, 10.0,
                       "in kilometres? Lengths are in m",
                       "in mm or cm? Multiply direction by 0.001 or 0.01"});
}

/// Tension that joints never reach, because friction is exhausted before. `key` ends in a dot.
std::optional<std::string> unused_tension(const std::string& key, double friction, double cohesion,
                                          double tension) {
  if (friction == 0.0 || tension <= cohesion / friction) return std::nullopt;
  return fmt::format(
      "{}tension = {:g} Pa exceeds cohesion / friction = {:g} Pa, at which a joint has no shear "
      "strength left; the smaller value applies",
      key, tension, cohesion / friction);
}

/// Of all joints, and of those groups whose own law causes it.
std::vector<std::string> unused_tensions(const Joints& joints) {
  const JointStrength& all = joints.strength;
  std::vector<std::string> found;
  const auto add = [&](const std::string& key, const JointLawChange& law) {
    const bool own = law.friction || law.cohesion || law.tension;
    const auto unused =
        unused_tension(key, law.friction.value_or(joints.friction), law.cohesion.value_or(all.cohesion),
                       law.tension.value_or(all.tension));
    if (own && unused) found.push_back(*unused);
  };
  if (const auto unused = unused_tension("joints.", joints.friction, all.cohesion, all.tension))
    found.push_back(*unused);
  for (const auto& [key, law] : joints.kinds()) add(fmt::format("joints.{}.", key), *law);
  for (size_t i = 0; i < joints.rings.size(); ++i)
    add(fmt::format("joints.rings[{}].", i), joints.rings[i].law);
  return found;
}

std::vector<PlausibleRange> member_checks(const Member& member, const std::string& key) {
  std::vector<PlausibleRange> checks = surface_checks(member.surface);
  if (!member.wythes.empty())
    std::erase_if(checks, [](const PlausibleRange& c) { return c.key == "surface.thickness"; });
  for (PlausibleRange& check : checks) check.key = key + "." + check.key;
  for (PlausibleRange& check : wythe_checks(member.wythes, key)) checks.push_back(std::move(check));
  return checks;
}

}  // namespace

std::vector<std::string> implausible_values(const Case& scene) {
  std::vector<PlausibleRange> checks;
  const std::vector<const Member*> members = members_of(scene.geometry);
  for (size_t i = 0; i < members.size() && !scene.geometry.imported; ++i)
    for (PlausibleRange& check : member_checks(*members[i], key_of_member(scene.geometry, i)))
      checks.push_back(std::move(check));
  for (PlausibleRange& check : material_checks(scene)) checks.push_back(std::move(check));
  add_joint_checks(scene.joints, &checks);
  add_load_checks(scene, &checks);
  add_analysis_checks(scene, &checks);
  std::vector<std::string> warnings = sentences(checks);
  for (std::string& unused : unused_tensions(scene.joints)) warnings.push_back(std::move(unused));
  return warnings;
}

}  // namespace cupola
