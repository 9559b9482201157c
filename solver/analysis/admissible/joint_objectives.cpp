#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/admissible/base_blocks.hpp"
#include "solver/analysis/admissible/range_objectives.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {
namespace {

constexpr const char* kQuantitiesKey = "analysis.range.quantities";

/// Outwards at a joint, in the frame of one of its free blocks.
Vec3 outward_at_joint(const JointForce& joint, const BlockPair& pair, const ForceScene& scene) {
  return scene.joints.outward(pair.centroid, scene.fixed(joint.block_a) ? joint.block_b : joint.block_a);
}

/// Part of the direction of a quantity in the plane of the joint, unit.
Vec3 in_plane(const JointForce& joint, const BlockPair& pair, const ForceScene& scene) {
  constexpr double kNormal = 1e-6;  // sine of the angle to the normal from which a direction lies along it
  const Vec3 given = joint.direction ? joint.direction->normalized() : outward_at_joint(joint, pair, scene);
  const Vec3 d = given - pair.normal * pair.normal.dot(given);
  if (d.norm() <= kNormal)
    throw InputError(fmt::format("{}: the direction is normal to joint {}-{}; give one in its plane",
                                 kQuantitiesKey, scene.label(joint.block_a), scene.label(joint.block_b)));
  return d.normalized();
}

RangeObjective normal_force(int block_a, int block_b, const ForceScene& scene) {
  ForceFunctional f = scene.zero();
  for (const int i : scene.joints.pair(block_a, block_b).contacts)
    f.add(i, scene.contacts.points[i].normal);  // compression positive
  return {fmt::format("normal force of joint {}-{}", scene.label(block_a), scene.label(block_b)),
          "N",
          std::move(f),
          {},
          std::minmax({block_a, block_b})};
}

/// rad, of a joint about the axis from which its upper block moves outwards; of a wall its own.
double azimuth_of(const BlockPair& pair, int block_a, int block_b, const Assembly& assembly) {
  const int ring = std::max(assembly.blocks[block_a].ring, assembly.blocks[block_b].ring);
  const Sheet* vault = assembly.vault_of(ring);
  const Vec3 own = (vault ? *vault : assembly.axis_of(ring)).own(pair.centroid);
  return std::atan2(own.y(), own.x());
}

}  // namespace

RangeObjective objective_of(const JointForce& joint, const ForceScene& scene) {
  using enum JointForce::Component;
  check_block(scene.assembly, joint.block_a);
  check_block(scene.assembly, joint.block_b);
  const BlockPair& pair = scene.joints.pair(joint.block_a, joint.block_b);
  const RangeObjective pressure = normal_force(joint.block_a, joint.block_b, scene);
  if (joint.component == normal) return pressure;
  const std::string name =
      fmt::format("{} of joint {}-{}{}", to_string(joint.component), scene.label(joint.block_a),
                  scene.label(joint.block_b), along_text(joint.direction));
  if (joint.component == eccentricity) {
    const Vec3 d = in_plane(joint, pair, scene);
    ForceFunctional moment = pressure.value;
    for (const int i : pair.contacts)
      moment.contacts.at(i) *= d.dot(scene.contacts.points[i].point_a - pair.centroid);
    return {name, "m", moment, pressure.value};
  }
  const Vec3 direction = joint.component == shear ? in_plane(joint, pair, scene)
                         : joint.direction        ? joint.direction->normalized()
                                                  : outward_at_joint(joint, pair, scene);
  ForceFunctional force = scene.zero();
  scene.add(pair, joint.block_b, direction, &force);
  return {name, "N", force};
}

RangeObjective objective_of(const HoopForce& hoop, const ForceScene& scene) {
  const auto in_ring = [&](int block) {
    return !scene.fixed(block) && scene.assembly.blocks[block].ring == hoop.ring;
  };
  if (hoop.ring >= scene.assembly.num_rings)
    throw InputError(fmt::format("{}: ring {} does not exist: the model has rings 0 to {}", kQuantitiesKey,
                                 hoop.ring, scene.assembly.num_rings - 1));
  const Sheet* sheet = scene.assembly.sheet_of(hoop.ring);
  if (!sheet || sheet->thrust_lines == Sheet::ThrustLines::none)
    throw InputError(
        fmt::format("{}: ring {} has no axis, so that it has no hoop force", kQuantitiesKey, hoop.ring));
  const auto along = [&](const Vec3& point) {
    constexpr double kMean = -0.5 / std::numbers::pi;
    return Vec3(kMean * sheet->outward(point).value());
  };
  ForceFunctional f = scene.zero();
  for (const auto& [key, pair] : scene.joints.pairs()) {
    const auto [a, b] = key;
    if (in_ring(a) == in_ring(b)) continue;
    for (const int i : pair.contacts) {
      const Contact& contact = scene.contacts.points[i];
      const Vec3 direction = along(contact.point_a);
      f.add(i, in_ring(contact.block_b) ? direction : Vec3(-direction));
    }
  }
  const State rest = state_at_rest(scene.model);
  for (size_t k = 0; k < scene.model.ties.size(); ++k) {
    const Tie& tie = scene.model.ties[k];
    const TieGeometry line = tie_geometry(tie, rest.poses, rest.ground);
    if (in_ring(tie.block_a)) f.ties[k] -= along(line.point_a).dot(line.normal);
    if (in_ring(tie.block_b)) f.ties[k] += along(line.point_b).dot(line.normal);
  }
  const LoadSet& loads = scene.model.loads;
  for (const int block : scene.model.free_blocks) {
    const Block& b = scene.assembly.blocks[block];
    if (in_ring(block)) f.constant += b.mass * along(b.centroid).dot(loads.gravity_at(rest.time));
  }
  for (const PointLoad& load : loads.points) {
    const Pose& pose = rest.poses[load.block];
    if (in_ring(load.block))
      f.constant +=
          loads.factor(load, rest.time) * along(pose.p_WB + pose.q_WB * load.p_BP_B).dot(load.force);
  }
  return {fmt::format("hoop force of ring {}", hoop.ring), "N", f, {}, {}};
}

std::vector<RangeObjective> objectives_of(const AllJoints& all, const ForceScene& scene) {
  constexpr double kSeam =
      1e-9;  // rounding of azimuths: a joint on the seam belongs to the sector that begins there
  const double turn = 2.0 * std::numbers::pi, sector = turn / all.sectors;
  const bool repeats = scene.scene.analysis.cyclic_sectors > 1;
  std::vector<RangeObjective> objectives;
  for (const auto& [key, pair] : scene.joints.pairs()) {
    const double azimuth = azimuth_of(pair, key.first, key.second, scene.assembly) + kSeam;
    if (azimuth + (azimuth < 0.0 ? turn : 0.0) >= sector) continue;
    RangeObjective& objective = objectives.emplace_back(normal_force(key.first, key.second, scene));
    if (!repeats) continue;
    objective.mean_of_images = true;
    objective.quantity = fmt::format("mean {} and its images", objective.quantity);
  }
  if (objectives.empty())
    throw InputError(fmt::format("{}: no joint lies in the first of {} sectors about the axis; give fewer",
                                 kQuantitiesKey, all.sectors));
  return objectives;
}

}  // namespace cupola
