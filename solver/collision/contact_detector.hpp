#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/collision/collision_model.hpp"
#include "solver/collision/patch_contacts.hpp"
#include "solver/collision/proximity.hpp"

namespace cupola {

struct DetectionOptions {
  /// m, >= 0: faces up to this far apart make contacts, so that closing gaps are known before they close.
  /// Larger: detection is needed less often, and brings in contacts that are not closed. 0: 1 % of the
  /// smallest free block (cube root of its volume).
  double margin = 0.0;
  PatchPoints points = PatchPoints::corners;
  /// Contacts are found again when a block has moved by this fraction of the margin, in (0, 0.25]: two blocks
  /// that approach each other unseen still have half the margin between them.
  double moved_fraction = 0.25;

  /// Throws InputError naming the value and the rule.
  void validate() const;
};

/// What detection remembers of the motion so far. Given back to a detector of the same assembly and options,
/// it goes on with the same bits.
struct DetectionMemory {
  std::vector<Pose> box_poses;        ///< of the boxes in the broad phase
  std::vector<Pose> detection_poses;  ///< at which contacts were last detected
  std::vector<Pose> current_poses;    ///< of the last update
  AnchoredContacts contacts;
  int num_detections = 0;
};

/// Finds the contacts of an assembly and follows them as the blocks move.
///
/// While no block has moved by more than a fraction of the margin, contacts are carried along: their two
/// points move with their blocks, the normal turns with the face it belongs to. Otherwise they are detected
/// anew, and a point of the same pair of faces keeps the identity of the old point that is nearest. Same
/// history of poses, same bits.
class ContactDetector {
 public:
  /// Throws InputError for invalid options or faces without area.
  ContactDetector(const Assembly& assembly, const DetectionOptions& options);

  /// Contacts at the given poses, one per block. The reference stays valid until the next call.
  const ContactSet& update(std::span<const Pose> poses);

  /// Contacts at the poses of the last update.
  const ContactSet& contacts() const { return contacts_.set; }

  /// What a checkpoint keeps, and how a new detector takes it over.
  DetectionMemory memory() const;
  void restore(const DetectionMemory& memory);

  int num_detections() const { return num_detections_; }
  double margin() const { return options_.margin; }  ///< m, in force

 private:
  bool moved_too_far(std::span<const Pose> poses) const;
  void detect(std::span<const Pose> poses);
  void update_broad_phase(std::span<const Pose> poses);
  void make_broad_phase(std::span<const Pose> poses);
  void carry_along(std::span<const Pose> poses);

  DetectionOptions options_;
  CollisionModel model_;
  NarrowPhaseOptions narrow_;
  std::optional<BroadPhase> broad_phase_;
  std::vector<Pose> box_poses_;  ///< of the boxes in the broad phase
  std::vector<Pose> detection_poses_;
  std::vector<Pose> current_poses_;
  AnchoredContacts contacts_;
  int num_detections_ = 0;
};

}  // namespace cupola
