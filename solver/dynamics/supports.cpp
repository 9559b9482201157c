#include "solver/dynamics/supports.hpp"

#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/time_table.hpp"

namespace cupola {
namespace {

std::vector<int> fixed_blocks(const Assembly& assembly) {
  std::vector<int> blocks;
  for (size_t block = 0; block < assembly.blocks.size(); ++block)
    if (assembly.blocks[block].fixed) blocks.push_back(static_cast<int>(block));
  return blocks;
}

std::vector<int> blocks_of_move(const SupportMove& move, const Assembly& assembly) {
  if (move.blocks.empty()) return fixed_blocks(assembly);
  const int num_blocks = static_cast<int>(assembly.blocks.size());
  for (int block : move.blocks) {
    if (block < 0 || block >= num_blocks)
      throw InputError(fmt::format("supports.moves: block {} does not exist: the assembly has blocks 0 to {}",
                                   block, num_blocks - 1));
    if (!assembly.blocks[block].fixed)
      throw InputError(
          fmt::format("supports.moves: block {} is not fixed; only supports can be moved", block));
  }
  return {move.blocks.begin(), move.blocks.end()};
}

Eigen::Quaterniond rotation_of(const Vec3& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle))
                     : Eigen::Quaterniond::Identity();
}

}  // namespace

std::vector<SupportMotion> make_support_motions(const Case& scene, const Assembly& assembly) {
  std::vector<SupportMotion> motions;
  if (scene.supports.base_motion) {
    const BaseMotion& base = *scene.supports.base_motion;
    TableInTime table = read_time_table(base.file);
    if (base.quantity == BaseMotion::Quantity::acceleration) table = integrate_twice(table);
    for (int block : fixed_blocks(assembly))
      motions.push_back({block, base.direction, Vec3::Zero(), Vec3::Zero(), table});
  }
  for (const SupportMove& move : scene.supports.moves)
    for (int block : blocks_of_move(move, assembly))
      motions.push_back(
          {block, move.displacement, std::numbers::pi / 180.0 * move.rotation_deg, move.pivot, move.time});
  return motions;
}

void place_supports(const Assembly& assembly, const std::vector<SupportMotion>& motions, double time,
                    std::vector<Pose>* poses) {
  for (const SupportMotion& motion : motions)
    (*poses)[motion.block] = {assembly.blocks[motion.block].centroid, Eigen::Quaterniond::Identity()};
  for (const SupportMotion& motion : motions) {
    const double factor = factor_at(motion.time, time);
    const Eigen::Quaterniond turn = rotation_of(factor * motion.rotation);
    Pose& pose = (*poses)[motion.block];
    pose.p_WB +=
        turn * (pose.p_WB - motion.pivot) - (pose.p_WB - motion.pivot) + factor * motion.displacement;
    pose.q_WB = (turn * pose.q_WB).normalized();
  }
}

Eigen::Matrix<double, 6, Eigen::Dynamic> block_velocities(const std::vector<Pose>& before,
                                                          const std::vector<Pose>& after, double h) {
  CUPOLA_ASSERT(before.size() == after.size() && h > 0.0);
  Eigen::Matrix<double, 6, Eigen::Dynamic> v(6, static_cast<Eigen::Index>(before.size()));
  for (size_t i = 0; i < before.size(); ++i) {
    const Eigen::AngleAxisd turn(after[i].q_WB * before[i].q_WB.conjugate());
    v.col(static_cast<Eigen::Index>(i)) << (after[i].p_WB - before[i].p_WB) / h,
        turn.angle() / h * turn.axis();
  }
  return v;
}

}  // namespace cupola
