#pragma once

#include <set>
#include <span>
#include <vector>

#include "solver/collision/contact_set.hpp"
#include "solver/collision/joint_patch.hpp"
#include "solver/collision/patch_quadrature.hpp"

namespace cupola {

/// Position of a contact on its blocks. Each vector is in the axes of its block, relative to its centroid.
struct ContactAnchor {
  Vec3 r_a = Vec3::Zero(), r_b = Vec3::Zero();              ///< m
  Vec3 normal_a = Vec3::UnitZ(), normal_b = Vec3::UnitZ();  ///< unit, from a to b
  double weight_a = 0.5;  ///< 1: the normal turns with a, 0: with b, 1/2: with both
  double rest_gap = 0.0;  ///< m, subtracted from the geometric gap
};

/// Contacts with the data that moves them along with their blocks.
struct AnchoredContacts {
  ContactSet set;
  std::vector<ContactAnchor> anchors;             ///< one per contact
  std::vector<std::vector<Vec3>> patch_polygons;  ///< m, one per patch, axes of block a
};

/// Appends the contacts and patches of all `chunks`, and leaves those empty.
void append(std::span<AnchoredContacts> chunks, AnchoredContacts* contacts);

/// Appends a patch and those of its contact points whose gap is within `margin` and `reach` (m) together;
/// `pose_ab` as for the patch. Their closed share is that of the faces within `margin`. An edge or
/// vertex contact has no area: each of its points gets `nominal_area` (m2) unless the patch has a
/// `point_area`. World positions are left to move_contacts().
void append_patch(const CollisionModel& model, const JointPatch& patch, const Eigen::Isometry3d& pose_ab,
                  double margin, double reach, const PatchSampling& sampling, double nominal_area,
                  AnchoredContacts* contacts);

/// Contacts and patches to update when some blocks move.
struct MovedContacts {
  std::vector<int> contacts;  ///< at least one of their blocks moves
  std::vector<int> patches;   ///< their block a moves
  std::vector<int> blocks;    ///< all blocks of those contacts and patches, moved or not
};
/// `moved`: 1 or 0 (num_blocks).
MovedContacts moved_contacts(const ContactSet& set, const std::vector<char>& moved);

/// Updates points, normals, gaps and patch polygons of the moved contacts; `poses` of all blocks
/// (num_blocks).
void move_contacts(std::span<const Pose> poses, const MovedContacts& moved, AnchoredContacts* contacts);

/// Transfers the identity and the rest gap of old contacts to new ones. Both sets must be in the same poses
/// and sorted by block pair.
///
/// Within a patch and the old patch that it continues, each new point takes over the nearest old point of the
/// same sort (corner or inner point), nearest pairs first. Points without a partner get unused numbers.
///
/// Returns the lateral contacts, which appeared because blocks slid along each other: further points of
/// patches that continue an old one, and all points of other patches of a block pair whose old patches all
/// continue.
std::set<ContactId> transfer_identities(const AnchoredContacts& old_contacts, AnchoredContacts* contacts);

/// Updates the rest gaps after a detection. Where blocks slide along each other while their joints are
/// compressed, faces meet that already overlap. Such `lateral` contacts start without force: their gap is
/// measured from its present value. Any other contact loses the part of its rest gap that has opened.
void update_rest_gaps(const std::set<ContactId>& lateral, AnchoredContacts* contacts);

}  // namespace cupola
