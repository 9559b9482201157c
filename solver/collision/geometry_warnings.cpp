#include "solver/collision/geometry_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/collision/face_clipping.hpp"
#include "solver/collision/separating_axis.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

constexpr double kOverlap = 1e-6;  // of the smallest block; 10,000 times the clipping tolerance
constexpr double kGap = 1e-3;      // of the smallest block; a tenth of the default margin

/// Largest value found for each pair of blocks.
using PairValues = std::map<std::pair<int, int>, double>;

void keep_largest(PairValues* values, std::pair<int, int> pair, double value) {
  double& largest = values->try_emplace(pair, value).first->second;
  largest = std::max(largest, value);
}

/// Defective joints.
struct BadJoints {
  PairValues overlaps;  // depth, m
  PairValues slivers;   // width, m
  PairValues gaps;      // m
};

/// The joint of two blocks, of all patches so far.
struct WholeJoint {
  double widest = 0.0;                                   // m, width of a patch; 0: none
  double gap = std::numeric_limits<double>::infinity();  // m, the least of patches that are no slivers
};

/// Checks parts i and k of two blocks.
void examine_parts(const Assembly& assembly, const ContactDetector& detector,
                   const Eigen::Isometry3d& pose_ab, const NarrowPhaseOptions& any_width, int i, int k,
                   WholeJoint* joint, BadJoints* bad) {
  const CollisionModel& model = detector.model();
  if (separated_by_face(model, i, k, pose_ab, any_width.margin)) return;
  const int a = model.parts[i].block, b = model.parts[k].block;
  const double depth = -separation(model, i, k, pose_ab, any_width);
  if (depth > detector.margin())
    throw InputError(
        fmt::format("blocks {} and {} overlap by {:.3g} m, more than contact.margin = {:.3g} m: correct the "
                    "geometry or increase contact.margin",
                    block_label(assembly, a), block_label(assembly, b), depth, detector.margin()));
  if (depth > kOverlap * model.smallest_block) keep_largest(&bad->overlaps, {a, b}, depth);
  if (joint->gap <= kGap * model.smallest_block) return;  // no sliver, and closed
  for (const JointPatch& patch : clip_opposed_faces(model, i, k, pose_ab, any_width)) {
    const double width = polygon_width(patch.outline());
    joint->widest = std::max(joint->widest, width);
    if (width >= detector.narrow_phase().min_width) joint->gap = std::min(joint->gap, patch.min_gap);
  }
}

/// Checks block a against the blocks of larger index.
void examine_block(const Assembly& assembly, const ContactDetector& detector, const std::vector<Pose>& poses,
                   const BroadPhase& near, const NarrowPhaseOptions& any_width, int a, BadJoints* bad) {
  const CollisionModel& model = detector.model();
  const auto box = [&](int block) { return model.box_at(block, poses[block], 0.5 * any_width.margin); };
  const OrientedBox box_a = box(a);
  for (const int b : near.partners(a)) {
    if (!overlap(box_a, box(b))) continue;
    Eigen::Isometry3d pose_ab = Eigen::Isometry3d::Identity();
    pose_ab.translation() = poses[b].p_WB - poses[a].p_WB;
    WholeJoint joint;  // parts of cut stones may share slivers of a joint that is wide as a whole
    for (int i = model.part_start[a]; i < model.part_start[a + 1]; ++i)
      for (int k = model.part_start[b]; k < model.part_start[b + 1]; ++k)
        examine_parts(assembly, detector, pose_ab, any_width, i, k, &joint, bad);
    if (joint.widest > 0.0 && joint.widest < detector.narrow_phase().min_width)
      bad->slivers[{a, b}] = joint.widest;
    if (joint.gap > kGap * model.smallest_block && std::isfinite(joint.gap)) bad->gaps[{a, b}] = joint.gap;
  }
}

/// One sentence about all joints that are drawn open.
std::string gaps_text(const Assembly& assembly, const PairValues& gaps) {
  const auto& [pair, gap] =
      *std::ranges::max_element(gaps, {}, [](const auto& of_pair) { return of_pair.second; });
  return fmt::format(
      "{} drawn open within contact.margin, by up to {:.3g} m between blocks {} and {}: such joints bear "
      "nothing until they close, and count as cracks, but ranges and limits take them as closed; if they are "
      "errors of the drawing, set contact.initial_gaps: ignore",
      counted(gaps.size(), "joint is", "joints are"), gap, block_label(assembly, pair.first),
      block_label(assembly, pair.second));
}

/// Smallest distance between a face and the vertex farthest behind it, m.
double thickness(const CollisionModel& model, const CollisionPart& part) {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const CollisionFace& face : model.faces_of(part)) {
    double depth = 0.0;
    for (const Vec3& x : model.vertices_of(part)) depth = std::max(depth, face.normal.dot(face.centroid - x));
    thinnest = std::min(thinnest, depth);
  }
  return thinnest;
}

}  // namespace

std::vector<std::string> geometry_warnings(const Assembly& assembly, const DetectionOptions& options) {
  const ContactDetector detector(assembly, options);
  const CollisionModel& model = detector.model();
  const std::vector<Pose> poses = initial_poses(assembly);
  NarrowPhaseOptions any_width = detector.narrow_phase();
  any_width.min_width *= kNoWidth;

  std::vector<Box> boxes;
  for (int block = 0; block < model.num_blocks(); ++block)
    boxes.push_back(bounding_box(model.box_at(block, poses[block], 0.5 * any_width.margin)));
  const BroadPhase near(boxes, collision_groups(model));
  std::vector<BadJoints> chunks((model.num_blocks() + kBlocksPerChunk - 1) / kBlocksPerChunk);
  share_loop(kOperationsPerBlock * model.num_blocks(), static_cast<int>(chunks.size()), [&](int chunk) {
    throw_if_interrupted();
    const int start = chunk * kBlocksPerChunk;
    for (int block = start; block < std::min(start + kBlocksPerChunk, model.num_blocks()); ++block)
      examine_block(assembly, detector, poses, near, any_width, block, &chunks[chunk]);
  });
  PairValues overlaps, slivers, gaps;
  for (const BadJoints& chunk : chunks) {
    if (!options.ignore_initial_gaps) {
      for (const auto& [pair, depth] : chunk.overlaps) keep_largest(&overlaps, pair, depth);
      for (const auto& [pair, gap] : chunk.gaps) keep_largest(&gaps, pair, gap);
    }
    for (const auto& [pair, width] : chunk.slivers) keep_largest(&slivers, pair, width);
  }

  std::vector<std::string> warnings;
  const auto label = [&](int block) { return block_label(assembly, block); };
  for (const auto& [pair, depth] : overlaps)
    warnings.push_back(fmt::format("blocks {} and {} overlap by {:.3g} m: their contacts start compressed",
                                   label(pair.first), label(pair.second), depth));
  if (!gaps.empty()) warnings.push_back(gaps_text(assembly, gaps));
  for (const auto& [pair, width] : slivers)
    warnings.push_back(
        fmt::format("blocks {} and {}: their joint is only {:.3g} m wide, less than 1e-3 of the smallest "
                    "block, and is ignored",
                    label(pair.first), label(pair.second), width));
  std::map<int, double> thin;
  for (const CollisionPart& part : model.parts) {
    const double part_thickness = thickness(model, part);
    if (part_thickness >= detector.margin()) continue;
    double& thinnest = thin.try_emplace(part.block, part_thickness).first->second;
    thinnest = std::min(thinnest, part_thickness);
  }
  for (const auto& [block, thinnest] : thin)
    warnings.push_back(fmt::format(
        "block {}: a part is only {:.3g} m thick, thinner than contact.margin = {:.3g} m; reduce the margin",
        label(block), thinnest, detector.margin()));
  return warnings;
}

}  // namespace cupola
