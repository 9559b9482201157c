#include "postproc/evaluation/thrust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "assembly/model/thrust_joint.hpp"

namespace cupola {
namespace {

/// N, on all supports; none without an axis.
std::optional<double> sum_over_supports(const Evaluation& e) {
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  if (e.assembly.num_rings > 0 || sheets.empty() || sheets.front().thrust_lines == Sheet::ThrustLines::none ||
      e.reactions.empty())
    return std::nullopt;
  double sum = 0.0;
  for (const Reaction& reaction : e.reactions) sum += reaction.outward;
  return above(sum, e.last.joints.floor.force);
}

/// True if all loads are vertical and joints are all that holds.
bool only_weighs(const Evaluation& e) {
  const Loads& loads = e.scene.loads;
  return !e.scene.joints.have_strength() && e.assembly.ties.empty() && e.scene.ties.pairs.empty() &&
         e.scene.supports.restraints.empty() && loads.gravity.head<2>().norm() == 0.0 &&
         std::ranges::all_of(
             loads.forces,
             [](const BlockForce& load) { return load.force.head<2>().norm() == 0.0 && !load.moment; }) &&
         std::ranges::all_of(loads.faces, [](const FaceLoad& load) {
           return load.pressure == 0.0 && load.traction.head<2>().norm() == 0.0 &&
                  (!load.fill || load.fill->horizontal == 0.0);
         });
}

}  // namespace

std::vector<const Sheet*> pushing_sheets(const Evaluation& e) {
  std::vector<const Sheet*> pushing;
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  for (size_t i = sheets.size(); i-- > 0;) {
    if (sheets[i].num_rings == 0 || sheets[i].thrust_lines == Sheet::ThrustLines::none) continue;
    const int first = e.assembly.stack_of(sheets[i].first_ring).first;
    if (!pushing.empty() && e.assembly.stack_of(pushing.back()->first_ring).first == first) continue;
    if (!e.rings.empty() && base_of(e, sheets[i]).blocks == 0) continue;
    pushing.push_back(&sheets[i]);
  }
  return pushing;
}

int lowest_course(const Assembly& assembly, const Sheet& sheet) {
  const auto [first, end] = assembly.stack_of(sheet.first_ring);
  int lowest = end;
  for (const Block& block : assembly.blocks)
    if (const int ring = ring_above_support(block); ring >= first) lowest = std::min(lowest, ring);
  return lowest < end ? lowest : first;
}

const RingSum& base_of(const Evaluation& e, const Sheet& sheet) {
  return e.rings.at(lowest_course(e.assembly, sheet));
}

bool alike(double a, double b) {
  return std::abs(a - b) <= 1e-3 * std::max(std::abs(a), std::abs(b));
}

std::vector<Thrust> thrusts_of(const Evaluation& e, const Sheet& sheet) {
  const bool arch = sheet.thrust_lines == Sheet::ThrustLines::one;
  std::array<std::optional<double>, 2> sides;  // the second of an arch at x < 0
  for (const JointWrench& joint : e.last.joints.wrenches) {
    const int bearer = bearer_of_thrust(e.assembly, sheet, joint, joint.centroid, joint.patch.plane.normal);
    if (bearer < 0) continue;
    const Vec3 outward = sheet.outward(joint.centroid).value();
    std::optional<double>& side = sides[arch && outward.dot(sheet.towards(0.0)) < 0.0 ? 1 : 0];
    side = side.value_or(0.0) + outward.dot(wrench_on(joint, bearer).force);
  }
  const auto thrust = [&](double force, const Vec3& towards) {
    return Thrust{above(force, e.last.joints.floor.force), arch ? std::optional(towards) : std::nullopt};
  };
  std::vector<Thrust> thrusts{thrust(sides[0].value_or(0.0), sheet.towards(0.0))};
  if (!sides[1]) return thrusts;
  thrusts.push_back(thrust(*sides[1], -sheet.towards(0.0)));
  if (thrusts[1].force > thrusts[0].force && !alike(thrusts[0].force, thrusts[1].force))
    std::swap(thrusts[0], thrusts[1]);
  return thrusts;
}

std::optional<double> outward_thrust(const Evaluation& e) {
  const std::vector<const Sheet*> pushing = pushing_sheets(e);
  if (pushing.empty()) return sum_over_supports(e);
  if (e.rings.empty()) return std::nullopt;
  return thrusts_of(e, *pushing.front()).front().force;
}

std::optional<double> net_hoop_tension(const Evaluation& e, double thrust) {
  if (!std::isfinite(thrust) || thrust >= 0.0 || !only_weighs(e)) return std::nullopt;
  const std::vector<const Sheet*> pushing = pushing_sheets(e);
  if (pushing.size() != 1 || !pushing.front()->closed) return std::nullopt;
  return -thrust / (2.0 * std::numbers::pi);
}

}  // namespace cupola
