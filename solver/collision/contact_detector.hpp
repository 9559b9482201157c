#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/collision/collision_model.hpp"
#include "solver/collision/patch_contacts.hpp"
#include "solver/collision/perturbed_gjk.hpp"
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

  /// None: face clipping, with edges and vertices by separating axes. Else the paper's narrow phase.
  std::optional<PerturbedGjkOptions> perturbed_gjk;

  /// The scene is plane (see plane_scene.hpp): two points that differ in y alone become one between them.
  bool plane = false;

  /// File of contact points that are followed and never found anew; empty: none (see contact_file.hpp).
  std::string contact_file;

  /// Throws InputError naming the value and the rule.
  void validate() const;
};

/// Where every block was at some time, and how far it might have gone until the next.
struct Reach {
  std::vector<Pose> poses;
  std::vector<double> travel;  ///< m
};

/// What detection remembers of the motion so far. Given back to a detector of the same assembly and options,
/// it goes on with the same bits.
struct DetectionMemory {
  Reach boxes;      ///< of the boxes in the broad phase
  Reach detection;  ///< at the last detection
  Reach now;        ///< at the last update
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

  /// Contacts at the given poses, one per block. `travel` tells how far points of each block may move until
  /// the next call (m; none: not at all): so much wider is the margin of its contacts, so that fast blocks
  /// meet no surface unseen. The reference stays valid until the next call.
  const ContactSet& update(std::span<const Pose> poses, std::span<const double> travel = {});

  /// From now on the gap of contact i counts such that it is `gaps[i]` (m, one per contact).
  void count_gaps_from(std::span<const double> gaps);

  /// Contacts at the poses of the last update.
  const ContactSet& contacts() const { return memory_.contacts.set; }

  /// What a checkpoint keeps, and how a new detector takes it over.
  const DetectionMemory& memory() const { return memory_; }
  void restore(DetectionMemory memory);

  int num_detections() const { return memory_.num_detections; }
  double margin() const { return options_.margin; }  ///< m, in force
  const CollisionModel& model() const { return model_; }
  const NarrowPhaseOptions& narrow_phase() const { return narrow_; }
  /// m, largest distance of a block's vertex from its centroid.
  double block_radius(int block) const { return model_.block_radius[block]; }

 private:
  Box padded_box(const Reach& reach, int block) const;
  void make_broad_phase(const Reach& reach);
  void update_broad_phase();
  bool still_reaches(const Reach& reach, int block) const;
  /// Given that no detection was needed before these blocks changed.
  bool needs_detection(const std::vector<int>& changed) const;
  void carry_contacts(const std::vector<char>& moved);
  void detect();
  AnchoredContacts find_contacts();
  /// Contacts of the blocks [block_start, block_end) with later ones.
  AnchoredContacts find_contacts(int block_start, int block_end) const;

  DetectionOptions options_;
  CollisionModel model_;
  NarrowPhaseOptions narrow_;
  std::optional<PerturbedGjk> perturbed_gjk_;
  std::optional<BroadPhase> broad_phase_;
  std::optional<AnchoredContacts> given_;  ///< from the contact file
  DetectionMemory memory_;
  std::vector<char> moved_;       ///< per block: in the last update that carried contacts along
  MovedContacts moved_contacts_;  ///< of those blocks
};

}  // namespace cupola
