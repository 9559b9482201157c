#include "solver/analysis/path_control.hpp"

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr int kTimes = 100;  // between 0 and the end, at which motions and loads are compared with those at 0

/// The largest of the vectors of some blocks.
struct LargestOfBlocks {
  int block = -1;
  Vec3 vector = Vec3::Zero();

  void include(int of, const Vec3& candidate) {
    constexpr double kEqual = 1e-9;  // relative difference of equal vectors by rounding
    if (candidate.norm() <= (1.0 + kEqual) * vector.norm()) return;
    block = of;
    vector = candidate;
  }
};

/// Displacements of supports, m.
LargestOfBlocks largest_support_motion(const Model& model, double end) {
  LargestOfBlocks largest;
  State start = state_at_rest(model);
  move_supports(model, &start);
  std::vector<Pose> poses = start.poses;
  for (int k = 1; k <= kTimes; ++k) {
    place_supports(*model.assembly, model.support_motions, end * k / kTimes, &poses);
    for (const SupportMotion& motion : model.support_motions)
      largest.include(motion.block, poses[motion.block].p_WB - start.poses[motion.block].p_WB);
  }
  return largest;
}

/// Changes of the loads on free blocks, N.
LargestOfBlocks largest_change_of_load(const Model& model, double end) {
  LargestOfBlocks largest;
  const State rest = state_at_rest(model);
  const VecX start = applied_forces(model, rest, 0.0);
  for (int k = 1; k <= kTimes; ++k) {
    const VecX change = applied_forces(model, rest, end * k / kTimes) - start;
    for (int i = 0; i < model.num_free(); ++i)
      largest.include(model.free_blocks[i], change.segment<3>(6 * i));
  }
  return largest;
}

int checked_block(int block, const Model& model) {
  check_block_exists(*model.assembly, block, "analysis.path.control");
  return block;
}

}  // namespace

LengthControl path_control(const LoadPath& options, const Model& model) {
  LengthControl control;
  control.latest = options.end;
  if (!options.control) {
    LargestOfBlocks largest = largest_support_motion(model, options.end);
    if (largest.block < 0) largest = largest_change_of_load(model, options.end);
    if (largest.block < 0)
      throw InputError(
          "analysis.path.control is missing, and nothing from which it would follow changes with time, "
          "neither the centroid of a support nor the sum of the forces on a block (turns, moments and heat "
          "give no direction): name a block, for example {block: 3, direction: [1, 0, 0]}");
    control.block = largest.block;
    control.direction = largest.vector.normalized();
    return control;
  }
  control.block = checked_block(options.control->block, model);
  if (options.control->relative_to) control.relative_to = checked_block(*options.control->relative_to, model);
  if (control.relative_to == control.block)
    throw InputError(
        fmt::format("analysis.path.control.relative_to = {}: must differ from block", control.block));
  control.direction = options.control->direction.normalized();
  return control;
}

}  // namespace cupola
