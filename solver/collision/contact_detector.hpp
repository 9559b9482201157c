#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/collision/collision_model.hpp"
#include "solver/collision/patch_contacts.hpp"
#include "solver/collision/perturbed_gjk.hpp"
#include "solver/collision/proximity.hpp"
#include "solver/collision/tracked_pairs.hpp"

namespace cupola {

struct DetectionOptions {
  /// m, >= 0: faces up to this far apart make contacts, so that gaps are known before they close. A larger
  /// margin requires detection less often but adds contacts that are open. 0: 1 % of the smallest free block
  /// (cube root of its volume).
  double margin = 0.0;
  PatchSampling sampling;
  /// The contacts of two blocks are computed again when the blocks have moved by this fraction of the margin
  /// relative to each other, in (0, 0.25]. Blocks that approach each other undetected are then still half the
  /// margin apart.
  double moved_fraction = 0.25;

  /// Set: the narrow phase of the paper. None: face clipping, and separating axes for edges and vertices.
  std::optional<PerturbedGjkOptions> perturbed_gjk;

  /// Plane scene (see plane_scene.hpp): two points that differ only in y are merged into one between them.
  bool plane = false;

  /// The joints as built count as closed: gaps are measured from those of the assembly as built.
  bool ignore_initial_gaps = false;

  /// File of contact points (see contact_file.hpp), which are carried along and never detected; empty: none.
  std::string contact_file;

  /// Throws InputError with the value and the rule.
  void validate() const;
};

/// Poses of all blocks at one time, and how far each block may move from there.
struct Reach {
  std::vector<Pose> poses;
  std::vector<double> travel;  ///< m
};

/// State of a detector that depends on the motion so far. A detector of the same assembly and options that
/// restores it continues with the same bits.
struct DetectionMemory {
  Reach boxes;  ///< covered by the boxes in the broad phase; at first those of the first detection
  Reach now;    ///< at the last update
  AnchoredContacts contacts;
  std::vector<TrackedPair> pairs;  ///< whose boxes overlap; empty until a block moves
  int num_detections = 0;
};

/// Finds the contacts of an assembly and tracks them as the blocks move.
///
/// While two blocks have not moved relative to each other by more than a fraction of the margin, their
/// contacts are carried along: the two points of a contact move with their blocks, and the normal turns with
/// the face that defines it. The polygons of joints and the contact points are therefore those of a new
/// detection up to that distance, and gaps up to the second order in it. Otherwise the contacts of the pair
/// are computed again, and each point takes over the identity of the nearest old point on the same pair of
/// faces. The same sequence of poses gives the same bits.
class ContactDetector {
 public:
  /// Throws InputError for invalid options or faces without area.
  ContactDetector(const Assembly& assembly, const DetectionOptions& options);

  /// Contacts at the given poses (num_blocks). `travel` (m, num_blocks; empty: zero) bounds how far the
  /// points of each block move until the next call. The margin of its contacts grows by that much, up to its
  /// radius: fast_pair() names faster blocks. The reference stays valid until the next call.
  const ContactSet& update(std::span<const Pose> poses, std::span<const double> travel = {});

  /// Sets the gap of contact i to `gaps[i]` (m, one per contact). Later gaps are measured relative to it.
  void set_gaps(std::span<const double> gaps);

  /// Contacts at the poses of the last update.
  const ContactSet& contacts() const { return memory_.contacts.set; }
  ContactSet take_contacts() && { return std::move(memory_.contacts.set); }  ///< without a copy

  /// For checkpoints.
  const DetectionMemory& memory() const { return memory_; }
  void restore(DetectionMemory memory);

  int num_detections() const { return memory_.num_detections; }
  double margin() const { return options_.margin; }  ///< m, with the default filled in
  const CollisionModel& model() const { return model_; }
  const NarrowPhaseOptions& narrow_phase() const { return narrow_; }
  /// m, largest distance of a vertex of the block from its centroid.
  double block_radius(int block) const { return model_.block_radius[block]; }

 private:
  OrientedBox padded_box(int block) const;  ///< around the block and where it may move from memory_.boxes
  bool within_box(int block) const;
  bool leaves_box(const std::vector<char>& changed) const;
  void make_broad_phase();
  void update_broad_phase();  ///< for the blocks that have left their boxes
  std::vector<TrackedPair> find_pairs() const;
  std::vector<TrackedPair> pairs_at_first_detection() const;
  bool has_moved(const TrackedPair& pair) const;  ///< so far that its contacts are computed again
  /// Marks stale pairs; true if there are some, or if pairs have vanished. `changed`: pose or travel
  /// (num_blocks).
  bool needs_detection(const std::vector<char>& changed);
  void carry_contacts(const std::vector<char>& moved);
  void detect();
  AnchoredContacts find_contacts(const std::vector<TrackedPair>& pairs) const;  ///< of the stale pairs
  void append_contacts(int a, int b, AnchoredContacts* contacts) const;

  DetectionOptions options_;
  CollisionModel model_;
  NarrowPhaseOptions narrow_;
  std::optional<PerturbedGjk> perturbed_gjk_;
  std::optional<BroadPhase> broad_phase_;
  std::optional<AnchoredContacts> contacts_from_file_;
  DetectionMemory memory_;
  std::vector<char> moved_;       ///< (num_blocks) which blocks the last call of carry_contacts() moved
  MovedContacts moved_contacts_;  ///< contacts of those blocks
};

}  // namespace cupola
