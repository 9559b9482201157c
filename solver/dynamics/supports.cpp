#include "solver/dynamics/supports.hpp"

#include <numbers>
#include <string>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_times.hpp"
#include "assembly/model/block_region.hpp"

namespace cupola {
namespace {

std::vector<int> fixed_blocks(const Assembly& assembly) {
  std::vector<int> blocks;
  for (size_t block = 0; block < assembly.blocks.size(); ++block)
    if (assembly.blocks[block].fixed) blocks.push_back(static_cast<int>(block));
  return blocks;
}

constexpr double kDegree = std::numbers::pi / 180.0;

/// The motions of one block of the region of a move.
void add_motions(const SupportMove& move, const RegionBlock& b, const Assembly& assembly,
                 const std::string& key, std::vector<SupportMotion>* motions) {
  Vec3 outward = Vec3::Zero();
  if (move.outward != 0.0 || move.tilt_deg != 0.0) outward = outward_of_support(assembly, b.block, key);
  motions->push_back({b.block, b.factor * (move.displacement + move.outward * outward),
                      b.factor * kDegree * move.rotation_deg, move.pivot, move.time});
  if (move.tilt_deg == 0.0) return;
  const Vec3 axis = Vec3::UnitZ().cross(outward);  // turns the top outwards
  motions->push_back({b.block, Vec3::Zero(), b.factor * kDegree * move.tilt_deg * axis,
                      assembly.blocks[b.block].centroid, move.time});
}

Eigen::Quaterniond rotation_of(const Vec3& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle))
                     : Eigen::Quaterniond::Identity();
}

}  // namespace

GroundMotion make_ground_motion(const Case& scene) {
  if (!scene.supports.base_motion) return {};
  return {scene.supports.base_motion->direction, ground_time(*scene.supports.base_motion)};
}

std::vector<SupportMotion> make_support_motions(const Case& scene, const Assembly& assembly) {
  std::vector<SupportMotion> motions;
  if (scene.supports.base_motion) {
    const GroundMotion ground = make_ground_motion(scene);
    for (int block : fixed_blocks(assembly))
      motions.push_back({block, ground.direction, Vec3::Zero(), Vec3::Zero(), ground.time});
  }
  const std::vector<SupportMove>& moves = scene.supports.moves;
  for (size_t i = 0; i < moves.size(); ++i) {
    const std::string key = fmt::format("supports.moves[{}]", i);
    for (const RegionBlock& b : blocks_of_region(moves[i].region, assembly, true, key))
      add_motions(moves[i], b, assembly, key, &motions);
  }
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
    const Vec3 arm = assembly.blocks[motion.block].centroid - motion.pivot;
    pose.p_WB += turn * arm - arm + factor * motion.displacement;
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
