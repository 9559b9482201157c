#include "solver/collision/contact_detector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/collision/contact_file.hpp"
#include "solver/collision/edge_contact.hpp"
#include "solver/collision/face_clipping.hpp"
#include "solver/collision/plane_contacts.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

constexpr double kCornerTolerance =
    1e-10;  // of the smallest block; a hundred times the rounding error of its corners

constexpr int kChunksAtOnce = 256;

/// Transforms coordinates from b's axes to a's. Subtracting the centroids first keeps the precision far from
/// the origin.
Eigen::Isometry3d relative_pose(const Pose& a, const Pose& b) {
  const Mat3 R_AW = a.q_WB.toRotationMatrix().transpose();
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  X_AB.linear() = R_AW * b.q_WB.toRotationMatrix();
  X_AB.translation() = R_AW * (b.p_WB - a.p_WB);
  return X_AB;
}

/// Upper bound of the distance that a point within `radius` of the centroid has moved, m.
double motion_bound(const Pose& from, const Pose& to, double radius) {
  return (to.p_WB - from.p_WB).norm() + radius * from.q_WB.angularDistance(to.q_WB);
}

bool same_pose(const Pose& p, const Pose& q) {
  return p.p_WB == q.p_WB && p.q_WB.coeffs() == q.q_WB.coeffs();
}

/// All patches between two blocks by face clipping.
std::vector<JointPatch> clip_blocks(const CollisionModel& model, int block_a, int block_b,
                                    const Eigen::Isometry3d& pose_ab, const NarrowPhaseOptions& options) {
  std::vector<JointPatch> patches;
  for (int a = model.part_start[block_a]; a < model.part_start[block_a + 1]; ++a) {
    for (int b = model.part_start[block_b]; b < model.part_start[block_b + 1]; ++b) {
      if (separated_by_face(model, a, b, pose_ab, options.margin)) continue;
      const std::vector<JointPatch> faces = clip_opposed_faces(model, a, b, pose_ab, options);
      patches.insert(patches.end(), faces.begin(), faces.end());
      if (!faces.empty()) continue;
      if (const auto edge = find_edge_contact(model, a, b, pose_ab, options)) patches.push_back(*edge);
    }
  }
  merge_coplanar(&patches, 10.0 * options.tolerance);
  return patches;
}

/// All patches between two blocks by the narrow phase of the paper.
std::vector<JointPatch> perturb_blocks(const PerturbedGjk& gjk, const CollisionModel& model, int block_a,
                                       int block_b, const Eigen::Isometry3d& pose_ab, double margin,
                                       double reach) {
  std::vector<JointPatch> patches;
  for (int a = model.part_start[block_a]; a < model.part_start[block_a + 1]; ++a) {
    for (int b = model.part_start[block_b]; b < model.part_start[block_b + 1]; ++b) {
      if (separated_by_face(model, a, b, pose_ab, margin + reach)) continue;
      if (auto patch = gjk.find(model, a, b, pose_ab, reach)) patches.push_back(std::move(*patch));
    }
  }
  return patches;
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
  if (!options_.contact_file.empty()) contacts_from_file_ = read_contacts(options_.contact_file, assembly);
  if (options_.perturbed_gjk) perturbed_gjk_.emplace(model_, *options_.perturbed_gjk);
  const JointRule rule = joint_rule(model_.smallest_block, options_.margin);
  if (options_.margin == 0.0) options_.margin = perturbed_gjk_ ? perturbed_gjk_->margin() : rule.margin;
  narrow_.margin = options_.margin;
  narrow_.min_width = rule.min_width;
  narrow_.max_angle = rule.max_angle;
  narrow_.tolerance = std::max(kCornerTolerance * model_.smallest_block, 16.0 * model_.rounding);
}

const ContactSet& ContactDetector::update(std::span<const Pose> poses, std::span<const double> travel) {
  CUPOLA_ASSERT(poses.size() == model_.block_radius.size());
  CUPOLA_ASSERT(travel.empty() || travel.size() == poses.size());
  Reach& now = memory_.now;
  now.poses.resize(poses.size());
  now.travel.resize(poses.size());
  std::vector<char> moved(poses.size(), 0);
  std::vector<int> changed;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    // Detection does not guarantee to find the contacts of a block that moves by its own size in one step.
    const double bound = travel.empty() ? 0.0 : std::min(travel[b], model_.block_radius[b]);
    moved[b] = !same_pose(poses[b], now.poses[b]);
    if (moved[b] || bound != now.travel[b]) changed.push_back(static_cast<int>(b));
    now.poses[b] = poses[b];
    now.travel[b] = bound;
  }
  if (memory_.num_detections == 0 || needs_detection(changed)) {
    detect();
  } else {
    carry_contacts(moved);
  }
  return memory_.contacts.set;
}

void ContactDetector::carry_contacts(const std::vector<char>& moved) {
  CUPOLA_ASSERT(memory_.contacts.anchors.size() == memory_.contacts.set.points.size());
  if (moved != moved_) moved_contacts_ = moved_contacts(memory_.contacts.set, moved);
  moved_ = moved;
  move_contacts(memory_.now.poses, moved_contacts_, &memory_.contacts);
}

bool ContactDetector::within_reach(const Reach& reach, int block) const {
  const double moved = motion_bound(reach.poses[block], memory_.now.poses[block], model_.block_radius[block]);
  return moved + memory_.now.travel[block] <= reach.travel[block] + options_.moved_fraction * options_.margin;
}

bool ContactDetector::needs_detection(const std::vector<int>& changed) const {
  if (contacts_from_file_) return false;
  for (const int b : changed) {
    if (!within_reach(memory_.detection, b)) return true;
    // A block that has come to rest no longer needs the distant contacts found while it was fast.
    if (memory_.detection.travel[b] - memory_.now.travel[b] > options_.margin) return true;
  }
  return false;
}

Box ContactDetector::padded_box(const Reach& reach, int block) const {
  // The boxes of two blocks within the margin overlap if each is enlarged by half of it. The rest of the
  // padding keeps the box valid while the block stays within reach.
  const double padding = (0.5 + options_.moved_fraction) * options_.margin + reach.travel[block];
  return bounding_box(model_.box_at(block, reach.poses[block], padding));
}

void ContactDetector::make_broad_phase(const Reach& reach) {
  std::vector<Box> boxes;
  for (int block = 0; block < model_.num_blocks(); ++block) boxes.push_back(padded_box(reach, block));
  broad_phase_.emplace(boxes, collision_groups(model_));
  memory_.boxes = reach;
}

void ContactDetector::update_broad_phase() {
  if (!broad_phase_) return make_broad_phase(memory_.now);
  std::vector<int> blocks;
  std::vector<Box> boxes;
  for (int block = 0; block < model_.num_blocks(); ++block) {
    if (within_reach(memory_.boxes, block)) continue;
    blocks.push_back(block);
    boxes.push_back(padded_box(memory_.now, block));
  }
  broad_phase_->move(blocks, boxes);
  for (const int block : blocks) {
    memory_.boxes.poses[block] = memory_.now.poses[block];
    memory_.boxes.travel[block] = memory_.now.travel[block];
  }
}

void ContactDetector::detect() {
  AnchoredContacts fresh = contacts_from_file_ ? *contacts_from_file_ : find_contacts();
  if (options_.plane) merge_across_plane(1e3 * narrow_.tolerance, &fresh);
  std::set<ContactId> lateral = transfer_identities(memory_.contacts, &fresh);
  // Overlaps as built are left to the solver. With compliance per area the points of a small area are so
  // compliant that their force stays small.
  if (memory_.num_detections == 0 || options_.sampling.points != PatchPoints::corners) lateral.clear();
  memory_.contacts = std::move(fresh);
  moved_.clear();  // moved_contacts_ refers to the old contacts
  carry_contacts(std::vector<char>(memory_.now.poses.size(), 1));
  update_rest_gaps(lateral, &memory_.contacts);
  memory_.detection = memory_.now;
  ++memory_.num_detections;
}

AnchoredContacts ContactDetector::find_contacts() {
  update_broad_phase();
  // Chunks of blocks. They are merged in batches, because all chunks of a large model at once would take as
  // much memory as the result.
  const int num_blocks = model_.num_blocks();
  const int num_chunks = (num_blocks + kBlocksPerChunk - 1) / kBlocksPerChunk;
  AnchoredContacts fresh;
  for (int first = 0; first < num_chunks; first += kChunksAtOnce) {
    const int count = std::min(kChunksAtOnce, num_chunks - first);
    std::vector<AnchoredContacts> chunks(count);
    share_loop(kOperationsPerBlock * kBlocksPerChunk * count, count, [&](int i) {
      throw_if_interrupted();
      const int start = (first + i) * kBlocksPerChunk;
      chunks[i] = find_contacts(start, std::min(start + kBlocksPerChunk, num_blocks));
    });
    for (AnchoredContacts& chunk : chunks) append(std::move(chunk), &fresh);
    if (first > 0) continue;
    // The other chunks have about as many contacts. Reserved but unused pages take no memory.
    const std::size_t expected = fresh.anchors.size() * num_chunks / count;
    fresh.set.points.reserve(expected + expected / 4);
    fresh.anchors.reserve(expected + expected / 4);
  }
  return fresh;
}

AnchoredContacts ContactDetector::find_contacts(int block_start, int block_end) const {
  const Reach& now = memory_.now;
  const double nominal_area = model_.smallest_block * model_.smallest_block / 12.0;
  AnchoredContacts fresh;
  NarrowPhaseOptions narrow = narrow_;
  const auto box = [&](int block) {
    return model_.box_at(block, now.poses[block], 0.5 * options_.margin + now.travel[block]);
  };
  for (int a = block_start; a < block_end; ++a) {
    const OrientedBox box_a = box(a);
    for (const int b : broad_phase_->partners(a)) {
      if (!overlap(box_a, box(b))) continue;
      const Eigen::Isometry3d pose_ab = relative_pose(now.poses[a], now.poses[b]);
      const double reach = now.travel[a] + now.travel[b];
      narrow.margin = options_.margin + reach;
      for (const JointPatch& patch :
           perturbed_gjk_ ? perturb_blocks(*perturbed_gjk_, model_, a, b, pose_ab, options_.margin, reach)
                          : clip_blocks(model_, a, b, pose_ab, narrow))
        append_patch(model_, patch, pose_ab, narrow.margin, options_.sampling, nominal_area, &fresh);
    }
  }
  return fresh;
}

void ContactDetector::set_gaps(std::span<const double> gaps) {
  std::vector<Contact>& contacts = memory_.contacts.set.points;
  CUPOLA_ASSERT(gaps.size() == contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    memory_.contacts.anchors[i].rest_gap += contacts[i].gap - gaps[i];
    contacts[i].gap = gaps[i];
  }
}

void ContactDetector::restore(DetectionMemory memory) {
  CUPOLA_ASSERT(memory.num_detections == 0 || memory.now.poses.size() == model_.block_radius.size());
  CUPOLA_ASSERT(memory.contacts.anchors.size() == memory.contacts.set.points.size());
  memory_ = std::move(memory);
  moved_.clear();
  if (memory_.num_detections > 0 && !contacts_from_file_) make_broad_phase(Reach(memory_.boxes));
}

}  // namespace cupola
