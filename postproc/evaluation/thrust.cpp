#include "postproc/evaluation/thrust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "assembly/model/thrust_joint.hpp"
#include "postproc/mechanics/shell.hpp"

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

/// True if stones of the stack lie at every azimuth about its axis: cuts may have left half a dome.
bool surrounds_its_axis(const Evaluation& e, const Sheet& sheet) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto [first, end] = e.assembly.stack_of(sheet.first_ring);
  std::vector<std::pair<double, double>> spans;  // rad, unwrapped
  double joint = 0.0;  // rad, the widest gap of joints above each other, as imperfections leave them
  for (int ring = first; ring < std::min(end, e.shell.num_rings()); ++ring)
    for (const BlockBed& block : e.shell.blocks[ring]) {
      const double from = wrapped(block.from), to = from + block.to - block.from;
      spans.emplace_back(from, to);
      spans.emplace_back(from - kTurn, to - kTurn);
      joint = 0.5 * e.shell.block_width_rad[ring];
    }
  std::ranges::sort(spans);
  double reached = -0.5 * kTurn;
  for (const auto& [from, to] : spans) {
    if (from > reached + joint) return false;
    reached = std::max(reached, to);
  }
  return reached > 0.5 * kTurn - joint;
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

/// The first and the last course of the stack of a sheet that have stones.
std::pair<int, int> courses_built(const Assembly& assembly, const Sheet& sheet) {
  const auto [first, end] = assembly.stack_of(sheet.first_ring);
  int lowest = end, highest = first;
  for (const Block& block : assembly.blocks) {
    const int ring = ring_above_support(block);
    if (ring < first || ring >= end) continue;
    lowest = std::min(lowest, ring);
    highest = std::max(highest, ring + block.num_rings - 1);
  }
  return {lowest < end ? lowest : first, highest};
}

std::vector<Thrust> thrusts_of(const Evaluation& e, const Sheet& sheet, const ThrustJoints& thrust_joints) {
  const bool arch = sheet.thrust_lines == Sheet::ThrustLines::one;
  const auto [lowest, highest] = courses_built(e.assembly, sheet);
  std::array<std::optional<Thrust>, 2> sides;  // the second of an arch where its courses end
  const auto [first, end] = e.assembly.stack_of(sheet.first_ring);
  const auto is_of_stack = [&e, first = first, end = std::max(end, 1)](int block) {
    const int ring = std::max(e.assembly.blocks[block].ring, 0);
    return !e.assembly.blocks[block].fixed && ring >= first && ring < end;
  };
  for (const JointWrench& joint : e.last.joints.wrenches) {
    if (!is_of_stack(joint.block_a) && !is_of_stack(joint.block_b)) continue;
    const int bearer = thrust_joints.bearer(sheet, joint, joint.centroid, joint.patch.plane.normal);
    if (bearer < 0) continue;
    const bool far = thrust_joints.is_at_far_side(sheet, joint.centroid);
    const int pushing = bearer == joint.block_a ? joint.block_b : joint.block_a;
    const Block& block = e.assembly.blocks[pushing];
    const double force =
        thrust_joints.outward(block.ring, joint.centroid).dot(wrench_on(joint, bearer).force);
    std::optional<Thrust>& side = sides[far ? 1 : 0];
    if (!side) side.emplace();
    side->force += force;
    if (!e.assembly.blocks[bearer].fixed) {
      side->on_blocks = true;
      continue;
    }
    side->held_higher |= far ? block.ring + block.num_rings <= highest : block.ring > lowest;
    auto support = std::ranges::find(side->supports, bearer, &Reaction::block);
    if (support == side->supports.end()) support = side->supports.insert(support, {bearer, block.ring});
    support->outward += force;
    support->length += has_scaled_joints(e) ? std::numeric_limits<double>::quiet_NaN()  // not the support's
                                            : support_length(joint, e.assembly, pushing, e.shell);
  }
  if (!sides[0]) sides[0].emplace();
  std::vector<Thrust> thrusts;
  for (std::optional<Thrust>& side : sides) {
    if (!side) continue;
    side->force = above(side->force, e.last.joints.floor.force);
    if (arch) side->towards = thrusts.empty() ? sheet.towards(0.0) : Vec3(-sheet.towards(0.0));
    thrusts.push_back(std::move(*side));
  }
  if (thrusts.size() > 1 && thrusts[1].force > thrusts[0].force && !alike(thrusts[0].force, thrusts[1].force))
    std::swap(thrusts[0], thrusts[1]);
  return thrusts;
}

}  // namespace

std::vector<const Sheet*> pushing_sheets(const Evaluation& e) {
  std::vector<const Sheet*> pushing = pushing_sheets(e.assembly);
  std::erase_if(pushing, [&e](const Sheet* sheet) {
    return sheet->num_rings == 0 || (!e.rings.empty() && base_of(e, *sheet).blocks == 0);
  });
  if (pushing.size() < 2 || e.rings.empty()) return pushing;
  const ThrustJoints joints(e.assembly);
  const auto force_of = [&](const Sheet* sheet) { return thrusts_of(e, *sheet, joints).front().force; };
  auto most = pushing.begin();
  double greatest = force_of(*most);
  for (auto next = most + 1; next != pushing.end(); ++next)
    if (const double force = force_of(*next); force > greatest && !alike(force, greatest)) {
      most = next;
      greatest = force;
    }
  std::rotate(pushing.begin(), most, most + 1);
  return pushing;
}

int lowest_course(const Assembly& assembly, const Sheet& sheet) {
  return courses_built(assembly, sheet).first;
}

const RingSum& base_of(const Evaluation& e, const Sheet& sheet) {
  return e.rings.at(lowest_course(e.assembly, sheet));
}

bool alike(double a, double b) {
  return std::abs(a - b) <= 1e-3 * std::max(std::abs(a), std::abs(b));
}

std::vector<Thrust> thrusts_of(const Evaluation& e, const Sheet& sheet) {
  return thrusts_of(e, sheet, ThrustJoints(e.assembly));
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
  if (pushing.size() != 1 || !pushing.front()->closed || !surrounds_its_axis(e, *pushing.front()) ||
      thrusts_of(e, *pushing.front()).front().held_higher)
    return std::nullopt;
  return -thrust / (2.0 * std::numbers::pi);
}

}  // namespace cupola
