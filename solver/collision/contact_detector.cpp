#include "solver/collision/contact_detector.hpp"

#include <algorithm>
#include <cmath>
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

/// The boxes of the broad phase are enlarged by this many margins, so that they stay valid for several steps.
constexpr double kBoxMargins = 5.0;

/// Multithreaded loop over pairs of blocks: its chunks, and the cost of a pair in floating-point operations.
constexpr int kChunksAtOnce = 256, kPairsPerChunk = 256;
constexpr double kOperationsPerPair = 2.5e4;

/// Transforms coordinates from b's axes to a's. Subtracting the centroids first keeps the precision far from
/// the origin.
Eigen::Isometry3d transform_to(const Pose& a, const Pose& b) {
  const Mat3 R_AW = a.q_WB.toRotationMatrix().transpose();
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  X_AB.linear() = R_AW * b.q_WB.toRotationMatrix();
  X_AB.translation() = R_AW * (b.p_WB - a.p_WB);
  return X_AB;
}

/// Records the configuration in which the contacts of a pair are computed.
void record(const Reach& reach, TrackedPair* pair) {
  pair->X_AB = relative_pose(reach.poses[pair->a], reach.poses[pair->b]);
  pair->travel = reach.travel[pair->a] + reach.travel[pair->b];
  pair->stale = false;
}

bool same_pose(const Pose& p, const Pose& q) {
  return p.p_WB == q.p_WB && p.q_WB.coeffs() == q.q_WB.coeffs();
}

/// Contacts of a part of block a with one of block b by face clipping.
struct PartContacts {
  int a = 0, b = 0;
  std::vector<JointPatch> faces, narrow;  ///< overlaps of faces; those narrower than min_width
};

/// Adds overlaps narrower than min_width that continue a wider one of the same two blocks: the cuts that
/// divide stones into parts leave such strips at the border of a bed, where hinges form.
void add_narrow_pieces(double tolerance, std::vector<PartContacts>* pairs) {
  if (std::ranges::all_of(*pairs, [](const PartContacts& pair) { return pair.narrow.empty(); })) return;
  std::vector<JointPatch> wide;
  for (const PartContacts& pair : *pairs) wide.insert(wide.end(), pair.faces.begin(), pair.faces.end());
  for (PartContacts& pair : *pairs)
    for (JointPatch& piece : pair.narrow)
      for (const JointPatch& p : wide) {
        piece.kind = p.kind;  // the face of a thin part, which makes no joint by itself, has none
        piece.ring = p.ring;
        if (!coplanar(p, piece, tolerance)) continue;
        pair.faces.push_back(std::move(piece));
        break;
      }
}

/// All patches between two blocks by face clipping.
std::vector<JointPatch> clip_blocks(const CollisionModel& model, int block_a, int block_b,
                                    const Eigen::Isometry3d& pose_ab, const NarrowPhaseOptions& options) {
  const double tolerance = 10.0 * options.tolerance;
  const auto is_divided = [&](int b) { return model.part_start[b + 1] - model.part_start[b] > 1; };
  const bool divided = is_divided(block_a) || is_divided(block_b);
  std::vector<PartContacts> pairs;
  for (int a = model.part_start[block_a]; a < model.part_start[block_a + 1]; ++a) {
    for (int b = model.part_start[block_b]; b < model.part_start[block_b + 1]; ++b) {
      if (separated_by_face(model, a, b, pose_ab, options.margin)) continue;
      PartContacts pair{a, b, {}, {}};
      pair.faces = clip_opposed_faces(model, a, b, pose_ab, options, divided ? &pair.narrow : nullptr);
      pairs.push_back(std::move(pair));
    }
  }
  add_narrow_pieces(tolerance, &pairs);
  std::vector<JointPatch> patches;
  for (const PartContacts& pair : pairs) {
    patches.insert(patches.end(), pair.faces.begin(), pair.faces.end());
    if (!pair.faces.empty()) continue;
    if (const auto edge = find_edge_contact(model, pair.a, pair.b, pose_ab, options))
      patches.push_back(*edge);
  }
  merge_coplanar(&patches, tolerance);
  drop_held_edges(options, &patches);
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
  if (!options_.contact_file.empty())
    contacts_from_file_ = read_contacts(options_.contact_file, assembly, options_.margin);
  if (options_.perturbed_gjk) perturbed_gjk_.emplace(model_, *options_.perturbed_gjk);
  const JointRule rule = joint_rule(model_.smallest_block, options_.margin);
  if (options_.margin == 0.0) options_.margin = perturbed_gjk_ ? perturbed_gjk_->margin() : rule.margin;
  narrow_.margin = options_.margin;
  narrow_.min_width = rule.min_width;
  narrow_.max_angle = rule.max_angle;
  narrow_.tolerance = std::max(kCornerTolerance * model_.smallest_block, 16.0 * model_.rounding);
  if (options_.ignore_initial_gaps) {
    const std::size_t num_contacts = update(initial_poses(assembly)).points.size();
    set_gaps(std::vector<double>(num_contacts, 0.0));
  }
}

const ContactSet& ContactDetector::update(std::span<const Pose> poses, std::span<const double> travel) {
  CUPOLA_ASSERT(poses.size() == model_.block_radius.size());
  CUPOLA_ASSERT(travel.empty() || travel.size() == poses.size());
  Reach& now = memory_.now;
  now.poses.resize(poses.size());
  now.travel.resize(poses.size());
  std::vector<char> moved(poses.size(), 0), changed(poses.size(), 0);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    // Contacts sought from farther away would be on faces past which the block moves (see fast_blocks.hpp).
    const double bound = travel.empty() ? 0.0 : std::min(travel[b], model_.block_radius[b]);
    moved[b] = !same_pose(poses[b], now.poses[b]);
    changed[b] = moved[b] || bound != now.travel[b];
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

bool ContactDetector::needs_detection(const std::vector<char>& changed) {
  const auto is_set = [](char flag) { return flag != 0; };
  if (contacts_from_file_ || std::none_of(changed.begin(), changed.end(), is_set)) return false;
  bool needed = false;
  if (memory_.pairs.empty() || leaves_box(changed)) {
    std::vector<TrackedPair> before = std::exchange(memory_.pairs, {});
    if (before.empty()) before = pairs_at_first_detection();
    update_broad_phase();
    memory_.pairs = find_pairs();
    take_configurations(before, memory_.pairs);
    needed = before.size() != memory_.pairs.size();
  }
  for (TrackedPair& pair : memory_.pairs) {
    if (!pair.stale && (changed[pair.a] || changed[pair.b])) pair.stale = has_moved(pair);
    needed = needed || pair.stale;
  }
  return needed;
}

bool ContactDetector::leaves_box(const std::vector<char>& changed) const {
  for (int block = 0; block < model_.num_blocks(); ++block)
    if (changed[block] && !within_box(block)) return true;
  return false;
}

bool ContactDetector::within_box(int block) const {
  const Pose &from = memory_.boxes.poses[block], &to = memory_.now.poses[block];
  const double moved = motion_bound(from, to, model_.block_radius[block]);
  return moved + memory_.now.travel[block] <= memory_.boxes.travel[block] + kBoxMargins * options_.margin;
}

bool ContactDetector::has_moved(const TrackedPair& pair) const {
  const Reach& now = memory_.now;
  const double travel = now.travel[pair.a] + now.travel[pair.b];
  const double moved = relative_motion(pair.X_AB, relative_pose(now.poses[pair.a], now.poses[pair.b]),
                                       model_.block_radius[pair.a], model_.block_radius[pair.b]);
  return moved > options_.moved_fraction * options_.margin ||
         moved + travel > pair.travel + 2.0 * options_.moved_fraction * options_.margin ||
         // Blocks that have come to rest no longer need the distant contacts found while they were fast.
         pair.travel - travel > options_.margin;
}

OrientedBox ContactDetector::padded_box(int block) const {
  // The boxes of two blocks within the margin overlap if each is enlarged by half of it. The rest of the
  // padding keeps the box valid while the block stays within reach.
  const double padding = (0.5 + kBoxMargins) * options_.margin + memory_.boxes.travel[block];
  return model_.box_at(block, memory_.boxes.poses[block], padding);
}

void ContactDetector::make_broad_phase() {
  std::vector<Box> boxes;
  for (int block = 0; block < model_.num_blocks(); ++block) boxes.push_back(bounding_box(padded_box(block)));
  broad_phase_.emplace(boxes, collision_groups(model_));
}

void ContactDetector::update_broad_phase() {
  std::vector<int> blocks;
  std::vector<Box> boxes;
  for (int block = 0; block < model_.num_blocks(); ++block) {
    if (within_box(block)) continue;
    memory_.boxes.poses[block] = memory_.now.poses[block];
    memory_.boxes.travel[block] = memory_.now.travel[block];
    blocks.push_back(block);
    boxes.push_back(bounding_box(padded_box(block)));
  }
  broad_phase_->move(blocks, boxes);
}

std::vector<TrackedPair> ContactDetector::find_pairs() const {
  const int num_blocks = model_.num_blocks();
  std::vector<std::vector<TrackedPair>> chunks((num_blocks + kBlocksPerChunk - 1) / kBlocksPerChunk);
  constexpr double kOperationsPerSearch = 1e4;
  share_loop(kOperationsPerSearch * num_blocks, static_cast<int>(chunks.size()), [&](int i) {
    for (int a = i * kBlocksPerChunk; a < std::min((i + 1) * kBlocksPerChunk, num_blocks); ++a) {
      const OrientedBox box = padded_box(a);
      for (const int b : broad_phase_->partners(a))
        if (overlap(box, padded_box(b))) chunks[i].push_back({a, b, {}, 0.0, true});
    }
  });
  std::vector<TrackedPair> pairs;
  for (const std::vector<TrackedPair>& chunk : chunks) pairs.insert(pairs.end(), chunk.begin(), chunk.end());
  return pairs;
}

std::vector<TrackedPair> ContactDetector::pairs_at_first_detection() const {
  std::vector<TrackedPair> pairs = find_pairs();
  for (TrackedPair& pair : pairs) record(memory_.boxes, &pair);
  return pairs;
}

void ContactDetector::detect() {
  const bool is_first = memory_.num_detections == 0;
  std::vector<TrackedPair> all;  // of the first detection, which are not kept: in statics nothing moves
  if (is_first && !contacts_from_file_) {
    memory_.boxes = memory_.now;
    make_broad_phase();
    all = find_pairs();
  }
  std::vector<TrackedPair>& pairs = is_first ? all : memory_.pairs;
  AnchoredContacts fresh = contacts_from_file_ ? *contacts_from_file_ : find_contacts(pairs);
  if (options_.plane) merge_across_plane(1e3 * narrow_.tolerance, &fresh);
  std::set<ContactId> lateral = transfer_identities(memory_.contacts, &fresh);
  // Overlaps as built are left to the solver. With compliance per area the points of a small area are so
  // compliant that their force stays small.
  if (is_first || options_.sampling.points != PatchPoints::corners) lateral.clear();
  if (is_first)
    memory_.contacts = std::move(fresh);
  else
    replace_contacts(pairs, std::move(fresh), &memory_.contacts);
  for (TrackedPair& pair : pairs)
    if (pair.stale) record(memory_.now, &pair);
  moved_.clear();  // moved_contacts_ refers to the old contacts
  carry_contacts(std::vector<char>(memory_.now.poses.size(), 1));
  update_rest_gaps(lateral, &memory_.contacts);
  ++memory_.num_detections;
}

AnchoredContacts ContactDetector::find_contacts(const std::vector<TrackedPair>& pairs) const {
  std::vector<const TrackedPair*> stale;
  for (const TrackedPair& pair : pairs)
    if (pair.stale) stale.push_back(&pair);
  // Chunks of pairs. They are merged in batches, because all chunks of a large model at once would take as
  // much memory as the result.
  const int num_pairs = static_cast<int>(stale.size());
  const int num_chunks = (num_pairs + kPairsPerChunk - 1) / kPairsPerChunk;
  AnchoredContacts fresh;
  for (int first = 0; first < num_chunks; first += kChunksAtOnce) {
    const int count = std::min(kChunksAtOnce, num_chunks - first);
    std::vector<AnchoredContacts> chunks(count);
    share_loop(kOperationsPerPair * kPairsPerChunk * count, count, [&](int i) {
      throw_if_interrupted();
      const int start = (first + i) * kPairsPerChunk;
      const std::span part = std::span(stale).subspan(start, std::min(kPairsPerChunk, num_pairs - start));
      for (const TrackedPair* pair : part) append_contacts(pair->a, pair->b, &chunks[i]);
    });
    append(chunks, &fresh);
    if (first > 0) continue;
    // The other chunks have about as many contacts. Reserved but unused pages take no memory.
    const std::size_t expected = fresh.anchors.size() * num_chunks / count;
    fresh.set.points.reserve(expected + expected / 4);
    fresh.anchors.reserve(expected + expected / 4);
  }
  return fresh;
}

void ContactDetector::append_contacts(int a, int b, AnchoredContacts* contacts) const {
  const Reach& now = memory_.now;
  const auto box = [&](int block) {
    return model_.box_at(block, now.poses[block], 0.5 * options_.margin + now.travel[block]);
  };
  if (!overlap(box(a), box(b))) return;
  const double nominal_area = model_.smallest_block * model_.smallest_block / 12.0;
  const Eigen::Isometry3d pose_ab = transform_to(now.poses[a], now.poses[b]);
  const double reach = now.travel[a] + now.travel[b];
  NarrowPhaseOptions narrow = narrow_;
  narrow.margin = options_.margin + reach;
  for (const JointPatch& patch :
       perturbed_gjk_ ? perturb_blocks(*perturbed_gjk_, model_, a, b, pose_ab, options_.margin, reach)
                      : clip_blocks(model_, a, b, pose_ab, narrow))
    append_patch(model_, patch, pose_ab, options_.margin, reach, options_.sampling, nominal_area, contacts);
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
  if (memory_.num_detections > 0 && !contacts_from_file_) make_broad_phase();
}

}  // namespace cupola
