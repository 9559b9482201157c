#include "solver/collision/contact_detector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/error.hpp"
#include "solver/collision/edge_contact.hpp"
#include "solver/collision/face_clipping.hpp"

namespace cupola {
namespace {

constexpr double kDefaultMargin = 0.01;  // of the smallest block
// Of the smallest block. A block that sinks into its bed by the joint's compliance overlaps the sides of its
// neighbours by that much: such slivers are no joints.
constexpr double kSliverWidth = 1e-3;
constexpr double kCornerTolerance = 1e-10;  // of the smallest block; a hundred roundings of its corners

Eigen::Isometry3d isometry(const Pose& pose) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = pose.q_WB.toRotationMatrix();
  X.translation() = pose.p_WB;
  return X;
}

/// Takes coordinates in b's axes to a's. The centroids are subtracted first, far from the origin.
Eigen::Isometry3d relative_pose(const Pose& a, const Pose& b) {
  const Mat3 R_AW = a.q_WB.toRotationMatrix().transpose();
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  X_AB.linear() = R_AW * b.q_WB.toRotationMatrix();
  X_AB.translation() = R_AW * (b.p_WB - a.p_WB);
  return X_AB;
}

/// Largest distance that a point within `radius` of the centroid has moved.
double motion_bound(const Pose& from, const Pose& to, double radius) {
  return (to.p_WB - from.p_WB).norm() + radius * from.q_WB.angularDistance(to.q_WB);
}

bool same_pose(const Pose& p, const Pose& q) {
  return p.p_WB == q.p_WB && p.q_WB.coeffs() == q.q_WB.coeffs();
}

Box part_box(const CollisionModel& model, const CollisionPart& part, const Pose& pose, double padding) {
  const Eigen::Isometry3d X_WB = isometry(pose);
  Box box;
  for (const Vec3& r : model.vertices_of(part)) box.extend(X_WB * r);
  box.min().array() -= padding;
  box.max().array() += padding;
  return box;
}

using PartPair = std::pair<int, int>;

std::pair<int, int> blocks_of(const CollisionModel& model, const PartPair& pair) {
  return {model.parts[pair.first].block, model.parts[pair.second].block};
}

/// All patches between two blocks.
std::vector<JointPatch> find_patches(const CollisionModel& model, std::span<const PartPair> pairs,
                                     const Eigen::Isometry3d& pose_ab, const NarrowPhaseOptions& options) {
  std::vector<JointPatch> patches;
  for (const auto& [a, b] : pairs) {
    const std::vector<JointPatch> faces = clip_opposed_faces(model, a, b, pose_ab, options);
    patches.insert(patches.end(), faces.begin(), faces.end());
    if (!faces.empty()) continue;
    if (const auto edge = find_edge_contact(model, a, b, pose_ab, options)) patches.push_back(*edge);
  }
  merge_coplanar(&patches, 10.0 * options.tolerance);
  return patches;
}

/// Two parts within the margin overlap by half of it each; boxes stay valid while their block moves by the
/// allowance.
double box_padding(const DetectionOptions& options) {
  return (0.5 + options.moved_fraction) * options.margin;
}

}  // namespace

void DetectionOptions::validate() const {
  if (!(margin >= 0.0) || !std::isfinite(margin))
    throw InputError(fmt::format("contact.margin = {}: must be >= 0 and finite", margin));
  if (!(moved_fraction > 0.0 && moved_fraction <= 0.25))
    throw InputError(fmt::format("moved_fraction = {}: must be in (0, 0.25]", moved_fraction));
}

ContactDetector::ContactDetector(const Assembly& assembly, const DetectionOptions& options)
    : options_(options), model_(make_collision_model(assembly)) {
  options_.validate();
  if (options_.margin == 0.0) options_.margin = kDefaultMargin * model_.smallest_block;
  narrow_.margin = options_.margin;
  narrow_.min_width = kSliverWidth * model_.smallest_block;
  narrow_.tolerance = std::max(kCornerTolerance * model_.smallest_block, 16.0 * model_.rounding);
}

const ContactSet& ContactDetector::update(std::span<const Pose> poses) {
  CUPOLA_ASSERT(poses.size() == model_.block_radius.size());
  if (num_detections_ == 0 || moved_too_far(poses)) {
    detect(poses);
  } else {
    carry_along(poses);
  }
  return contacts_.set;
}

bool ContactDetector::moved_too_far(std::span<const Pose> poses) const {
  const double allowed = options_.moved_fraction * options_.margin;
  for (std::size_t b = 0; b < poses.size(); ++b)
    if (!(motion_bound(detection_poses_[b], poses[b], model_.block_radius[b]) <= allowed)) return true;
  return false;
}

void ContactDetector::carry_along(std::span<const Pose> poses) {
  if (std::equal(poses.begin(), poses.end(), current_poses_.begin(), same_pose)) return;
  move_contacts(poses, &contacts_);
  current_poses_.assign(poses.begin(), poses.end());
}

void ContactDetector::make_broad_phase(std::span<const Pose> poses) {
  std::vector<Box> boxes;
  std::vector<int> groups;
  for (const CollisionPart& part : model_.parts) {
    boxes.push_back(part_box(model_, part, poses[part.block], box_padding(options_)));
    groups.push_back(part.fixed ? -1 : part.block);
  }
  broad_phase_.emplace(boxes, groups);
  box_poses_.assign(poses.begin(), poses.end());
}

void ContactDetector::update_broad_phase(std::span<const Pose> poses) {
  if (!broad_phase_) return make_broad_phase(poses);
  const double allowance = options_.moved_fraction * options_.margin;
  std::vector<int> indices;
  std::vector<Box> boxes;
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    const CollisionPart& part = model_.parts[p];
    const double radius = model_.block_radius[part.block];
    if (motion_bound(box_poses_[part.block], poses[part.block], radius) <= allowance) continue;
    indices.push_back(static_cast<int>(p));
    boxes.push_back(part_box(model_, part, poses[part.block], box_padding(options_)));
  }
  broad_phase_->move(indices, boxes);
  for (int p : indices) box_poses_[model_.parts[p].block] = poses[model_.parts[p].block];
}

void ContactDetector::detect(std::span<const Pose> poses) {
  update_broad_phase(poses);
  AnchoredContacts fresh;
  fresh.set.contacts.reserve(contacts_.set.contacts.size());
  fresh.anchors.reserve(contacts_.anchors.size());
  const double nominal_area = model_.smallest_block * model_.smallest_block / 12.0;
  std::vector<PartPair> pairs = broad_phase_->overlapping_pairs();
  const auto by_blocks = [&](const PartPair& p, const PartPair& q) {
    return blocks_of(model_, p) < blocks_of(model_, q);
  };
  std::stable_sort(pairs.begin(), pairs.end(), by_blocks);
  for (auto first = pairs.begin(); first != pairs.end();) {
    const auto last = std::upper_bound(first, pairs.end(), *first, by_blocks);
    const auto [block_a, block_b] = blocks_of(model_, *first);
    const Eigen::Isometry3d pose_ab = relative_pose(poses[block_a], poses[block_b]);
    for (const JointPatch& patch : find_patches(model_, {first, last}, pose_ab, narrow_))
      append_patch(model_, patch, pose_ab, options_.margin, options_.points, nominal_area, &fresh);
    first = last;
  }
  keep_identities(contacts_, &fresh);
  contacts_ = std::move(fresh);
  move_contacts(poses, &contacts_);
  detection_poses_.assign(poses.begin(), poses.end());
  current_poses_ = detection_poses_;
  ++num_detections_;
}

DetectionMemory ContactDetector::memory() const {
  return {box_poses_, detection_poses_, current_poses_, contacts_, num_detections_};
}

void ContactDetector::restore(const DetectionMemory& memory) {
  if (memory.num_detections > 0) make_broad_phase(memory.box_poses);
  detection_poses_ = memory.detection_poses;
  current_poses_ = memory.current_poses;
  contacts_ = memory.contacts;
  num_detections_ = memory.num_detections;
}

}  // namespace cupola
