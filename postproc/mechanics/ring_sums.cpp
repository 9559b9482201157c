#include "postproc/mechanics/ring_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "assembly/base/error.hpp"
#include "assembly/model/thrust_joint.hpp"
#include "postproc/mechanics/chain_forces.hpp"
#include "postproc/mechanics/stage_blocks.hpp"

namespace cupola {

int ring_above_support(const Block& block) {
  return block.fixed ? -1 : std::max(block.ring, 0);
}

int ring_above_support(const Assembly& assembly, int block, const std::vector<bool>& left_out) {
  return takes_part(assembly, block, left_out) ? ring_above_support(assembly.blocks[block]) : -1;
}

namespace {

/// m, mean height of a bed by the area of its facets; NaN without any.
double height_as_built(const std::vector<BedFacet>& bed) {
  double sum = 0.0, whole = 0.0;
  for (const BedFacet& f : bed) {
    const double area = polygon_area(std::array{f.intrados_a, f.intrados_b, f.extrados_b, f.extrados_a});
    sum += area * 0.25 * (f.intrados_a + f.intrados_b + f.extrados_a + f.extrados_b).z();
    whole += area;
  }
  return whole > 0.0 ? sum / whole : std::numeric_limits<double>::quiet_NaN();
}

/// Turns the load of each ring into the load above each cut of its stack.
void accumulate_downwards(const Assembly& assembly, std::vector<RingSum>* rings) {
  for (size_t k = rings->size(); k-- > 1;)
    if (assembly.stack_of(static_cast<int>(k)).first != static_cast<int>(k))
      (*rings)[k - 1].load_above += (*rings)[k].load_above;
}

void add_loads(const Assembly& assembly, const Vec3& gravity, const std::vector<PointForce>& loads,
               const std::vector<bool>& left_out, std::vector<RingSum>* rings) {
  for (size_t b = 0; b < assembly.blocks.size(); ++b) {
    const int k = ring_above_support(assembly, static_cast<int>(b), left_out);
    if (k < 0) continue;
    (*rings)[k].load_above += assembly.blocks[b].mass * gravity;
    ++(*rings)[k].blocks;
  }
  for (const PointForce& load : loads)
    if (const int k = ring_above_support(assembly, load.block, left_out); k >= 0)
      (*rings)[k].load_above += load.force;
  accumulate_downwards(assembly, rings);
}

/// Sums the joint forces across each cut: those on the blocks above it in its stack. A joint between blocks
/// of first rings p < q of one stack crosses the cuts p + 1 .. q, so its force is added at p + 1, removed at
/// q + 1, and the changes are summed from the base upwards. A joint between two stacks crosses all cuts below
/// each of its blocks.
void add_joint_forces(const Assembly& assembly, const JointWrenches& joints, const TieTable& ties,
                      const std::vector<bool>& left_out, std::vector<RingSum>* rings) {
  std::vector<Vec3> change(rings->size(), Vec3::Zero());
  const auto add_to_cuts = [&](int from, int to, const Vec3& force) {
    change[from] += force;
    if (to + 1 < static_cast<int>(change.size()) && assembly.stack_of(to + 1).first != to + 1)
      change[to + 1] -= force;
  };
  const auto add = [&](int block_a, int block_b, const Vec3& force_on_b) {
    const int a = ring_above_support(assembly, block_a, left_out),
              b = ring_above_support(assembly, block_b, left_out);
    if (a == b) return;
    const Vec3 on_upper = b > a ? force_on_b : Vec3(-force_on_b);
    const int lower = std::min(a, b), upper = std::max(a, b), base = assembly.stack_of(upper).first;
    add_to_cuts(std::max(lower + 1, base), upper, on_upper);
    if (lower >= 0 && lower < base) add_to_cuts(assembly.stack_of(lower).first, lower, -on_upper);
  };
  for (const JointWrench& joint : joints.wrenches) add(joint.block_a, joint.block_b, joint.wrench.force);
  for (int i = 0; i < ties.size(); ++i) add(ties.block_a[i], ties.block_b[i], tie_force_on_b(ties, i));
  Vec3 force = Vec3::Zero();
  for (size_t k = 0; k < rings->size(); ++k) {
    if (assembly.stack_of(static_cast<int>(k)).first == static_cast<int>(k)) force.setZero();
    force += change[k];
    (*rings)[k].joint_force = force;
  }
}

/// Sums what blocks push outwards across the cuts of their stack on blocks below, whichever way their joints
/// face: blocks of several courses pass the cuts above their first.
void add_outward_between_rings(const Assembly& assembly, const JointWrenches& joints,
                               std::vector<RingSum>* rings) {
  for (const JointWrench& joint : joints.wrenches) {
    const int a = ring_above_support(assembly.blocks[joint.block_a]),
              b = ring_above_support(assembly.blocks[joint.block_b]);
    const auto [lower, upper] = std::minmax(a, b);
    if (lower < assembly.stack_of(std::max(upper, 0)).first) continue;  // a support, or another stack
    const Vec3 on_upper = wrench_on(joint, b > a ? joint.block_b : joint.block_a).force;
    for (int k = lower + 1; k <= upper; ++k)
      (*rings)[k].radial_thrust -= assembly.outward(k, joint.centroid).dot(on_upper);
  }
}

/// The block that leans on a support beside it by this joint, or of the first course of a stack stands on
/// another stack, whichever way the joint faces: a springer of a groin vault also leans on its pier.
std::optional<int> leaning_block(const Assembly& assembly, const JointWrench& joint) {
  const auto ring = [&](int block) { return ring_above_support(assembly.blocks[block]); };
  const auto [lower, upper] = ring(joint.block_a) < ring(joint.block_b)
                                  ? std::pair(joint.block_a, joint.block_b)
                                  : std::pair(joint.block_b, joint.block_a);
  if (ring(lower) == ring(upper)) return std::nullopt;
  const bool leans = ring(lower) < 0 ? joint.upper < 0 : assembly.stack_of(ring(upper)).first == ring(upper);
  return leans ? std::optional(upper) : std::nullopt;
}

/// True for the upright face of a support, as of a wall that holds the end of a course: it is not its bed.
bool holds_end(const Assembly& assembly, int below, const JointWrench& joint) {
  constexpr double kUpright = 1e-6;  // cosine; planes are exact to rounding
  return assembly.blocks[below].fixed && std::abs(joint.patch.plane.normal.z()) <= kUpright;
}

/// Fills in how evenly the blocks of each ring are loaded.
void add_uniformity(const Assembly& assembly, const JointWrenches& joints,
                    const std::vector<Wrench>& from_below, std::vector<RingSum>* rings) {
  std::vector<double> normal_force(from_below.size(), 0.0), area(from_below.size(), 0.0);
  std::vector<double> ring_area(rings->size(), 0.0), moment(ring_area);  // m2, and m3 of heights
  std::vector<double> leaning_area(ring_area), leaning_moment(ring_area);
  std::vector<char> is_carried(from_below.size(), 0);
  const ThrustJoints thrust(assembly);
  for (const JointWrench& joint : joints.wrenches) {
    if (const auto leaning = leaning_block(assembly, joint); leaning && joint.carried < 0) {
      const int k = ring_above_support(assembly.blocks[*leaning]);
      (*rings)[k].radial_thrust -= thrust.outward(k, joint.centroid).dot(wrench_on(joint, *leaning).force);
      leaning_moment[k] += joint.area * joint.patch.centroid.z();
      leaning_area[k] += joint.area;
    }
    const int carried = joint.carried;
    if (carried < 0 || assembly.blocks[carried].fixed) continue;
    is_carried[carried] = 1;
    normal_force[carried] += joint.normal_force;
    area[carried] += joint.area;
    const int k = ring_above_support(assembly.blocks[carried]);
    const int below = carried == joint.block_a ? joint.block_b : joint.block_a;
    RingSum& ring = (*rings)[k];
    const bool end = holds_end(assembly, below, joint);
    (end ? leaning_moment : moment)[k] += joint.area * joint.patch.centroid.z();
    (end ? leaning_area : ring_area)[k] += joint.area;
    ring.largest_friction_use = std::fmax(ring.largest_friction_use, joint.friction_use);  // skips NaN
    ring.largest_kern = std::fmax(ring.largest_kern, joint.kern);
    if (ring_above_support(assembly.blocks[below]) < assembly.stack_of(k).first)
      ring.radial_thrust -= thrust.outward(k, joint.centroid).dot(wrench_on(joint, carried).force);
  }
  std::vector<std::vector<double>> resultants(rings->size()), pressures(rings->size());
  for (size_t b = 0; b < from_below.size(); ++b) {
    if (is_carried[b] == 0) continue;
    const int k = ring_above_support(assembly.blocks[b]);
    resultants[k].push_back(from_below[b].force.norm());
    if (area[b] > 0.0) pressures[k].push_back(normal_force[b] / area[b]);
    RingSum& ring = (*rings)[k];
    ring.mean_resultant += resultants[k].back();
    ring.largest_couple_length =
        std::fmax(ring.largest_couple_length, couple_length(from_below[b], joints.floor));
  }
  for (size_t k = 0; k < rings->size(); ++k) {
    RingSum& ring = (*rings)[k];
    if (ring_area[k] > 0.0)
      ring.height = moment[k] / ring_area[k];
    else if (std::isnan(ring.height) && leaning_area[k] > 0.0)
      ring.height = leaning_moment[k] / leaning_area[k];
    if (!resultants[k].empty()) ring.mean_resultant /= static_cast<double>(resultants[k].size());
    ring.cv_resultant = above(coefficient_of_variation(resultants[k]), joints.floor.share);
    ring.cv_pressure = above(coefficient_of_variation(pressures[k]), joints.floor.share);
    ring.radial_thrust = above(ring.radial_thrust, joints.floor.force);
  }
}

}  // namespace

double coefficient_of_variation(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  if (mean == 0.0) return 0.0;
  double variance = 0.0;
  for (const double v : values) variance += (v - mean) * (v - mean) / static_cast<double>(values.size());
  return std::sqrt(variance) / std::abs(mean);
}

std::vector<RingSum> ring_sums(const Assembly& assembly, const Shell& shell, const JointWrenches& joints,
                               const std::vector<Wrench>& from_below, const Vec3& gravity,
                               const std::vector<PointForce>& loads, const TieTable& ties,
                               const std::vector<bool>& left_out) {
  CUPOLA_ASSERT(from_below.size() == assembly.blocks.size());
  int num_rings = 0;
  if (assembly.num_rings > 0)
    for (const Block& block : assembly.blocks)
      if (!block.fixed) num_rings = std::max(num_rings, block.ring + 1);
  std::vector<RingSum> rings(static_cast<size_t>(num_rings));
  if (rings.empty()) return rings;
  for (int k = 0; k < num_rings; ++k) rings[k] = {.ring = k, .height = height_as_built(shell.beds[k])};
  add_loads(assembly, gravity, loads, left_out, &rings);
  add_joint_forces(assembly, joints, ties, left_out, &rings);
  add_outward_between_rings(assembly, joints, &rings);
  add_uniformity(assembly, joints, from_below, &rings);
  for (RingSum& ring : rings) {
    if (ring.blocks == 0 && !left_out.empty()) ring = {.ring = ring.ring, .height = ring.height};
    const double load = ring.load_above.norm();
    if (load > 0.0) ring.relative_difference = (ring.joint_force + ring.load_above).norm() / load;
  }
  return rings;
}

}  // namespace cupola
