#include "postproc/evaluation/thrust.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "postproc/mechanics/ring_sums.hpp"

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

/// N, at the springing of an arch at x < 0 in its own frame; none of a half arch.
std::optional<double> thrust_of_other_side(const Evaluation& e, const Sheet& sheet) {
  const auto [first, end] = e.assembly.stack_of(sheet.first_ring);
  const auto in_stack = [&, first = first, end = end](int block) {
    const int ring = ring_above_support(e.assembly.blocks[block]);
    return ring >= first && ring < end;
  };
  std::optional<double> thrust;
  for (const JointWrench& joint : e.last.joints.wrenches) {
    const bool holds_a = in_stack(joint.block_a), holds_b = in_stack(joint.block_b);
    if (holds_a == holds_b || sheet.own(joint.centroid).x() >= 0.0) continue;
    const int outside = holds_a ? joint.block_b : joint.block_a;
    if (ring_above_support(e.assembly.blocks[outside]) >= end) continue;  // leans on the arch
    const Vec3 outward = -sheet.towards(0.0);
    thrust = thrust.value_or(0.0) + outward.dot(wrench_on(joint, outside).force);
  }
  return thrust ? std::optional(above(*thrust, e.last.joints.floor.force)) : std::nullopt;
}

}  // namespace

std::vector<const Sheet*> pushing_sheets(const Evaluation& e) {
  std::vector<const Sheet*> pushing;
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  for (size_t i = sheets.size(); i-- > 0;)
    if ((i + 1 == sheets.size() || !sheets[i + 1].on_previous) && sheets[i].num_rings > 0 &&
        sheets[i].thrust_lines != Sheet::ThrustLines::none)
      pushing.push_back(&sheets[i]);
  return pushing;
}

const RingSum& base_of(const Evaluation& e, const Sheet& sheet) {
  return e.rings.at(e.assembly.stack_of(sheet.first_ring).first);
}

bool alike(double a, double b) {
  return std::abs(a - b) <= 1e-3 * std::max(std::abs(a), std::abs(b));
}

std::vector<Thrust> thrusts_of(const Evaluation& e, const Sheet& sheet) {
  const double first = base_of(e, sheet).radial_thrust;
  if (sheet.thrust_lines != Sheet::ThrustLines::one) return {{first, std::nullopt}};
  std::vector<Thrust> thrusts{{first, sheet.towards(0.0)}};
  if (const std::optional<double> other = thrust_of_other_side(e, sheet)) {
    thrusts.push_back({*other, -sheet.towards(0.0)});
    if (*other > first && !alike(first, *other)) std::swap(thrusts[0], thrusts[1]);
  }
  return thrusts;
}

std::optional<double> outward_thrust(const Evaluation& e) {
  const std::vector<const Sheet*> pushing = pushing_sheets(e);
  if (pushing.empty()) return sum_over_supports(e);
  if (e.rings.empty()) return std::nullopt;
  const RingSum& base = base_of(e, *pushing.front());
  return base.blocks > 0 ? std::optional(thrusts_of(e, *pushing.front()).front().force) : std::nullopt;
}

}  // namespace cupola
