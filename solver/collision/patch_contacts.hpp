#pragma once

#include <set>
#include <span>
#include <vector>

#include "solver/collision/contact_set.hpp"
#include "solver/collision/joint_patch.hpp"
#include "solver/collision/patch_quadrature.hpp"

namespace cupola {

/// Where a contact sits on its blocks, each vector in the axes of its block, relative to its centroid.
struct ContactAnchor {
  Vec3 r_a = Vec3::Zero(), r_b = Vec3::Zero();              ///< m
  Vec3 normal_a = Vec3::UnitZ(), normal_b = Vec3::UnitZ();  ///< the normal, from a to b
  double weight_a = 0.5;  ///< 1: the normal turns with a, 0: with b, 1/2: with both
  double rest_gap = 0.0;  ///< m: the gap counts from here
};

/// Contacts with what is needed to move them along with their blocks.
struct AnchoredContacts {
  ContactSet set;
  std::vector<ContactAnchor> anchors;             ///< one per contact
  std::vector<std::vector<Vec3>> patch_polygons;  ///< m, one per patch, axes of block a
};

/// Appends all contacts and patches of `more`.
void append(AnchoredContacts more, AnchoredContacts* contacts);

/// Appends a patch and its contact points within the margin; `pose_ab` as for the patch. An edge or a vertex
/// has no area: each of its points stands for `nominal_area` (m2), unless the patch knows better. Positions
/// in the world are left to move_contacts().
void append_patch(const CollisionModel& model, const JointPatch& patch, const Eigen::Isometry3d& pose_ab,
                  double margin, PatchPoints points, double nominal_area, AnchoredContacts* contacts);

/// What goes along when some blocks move.
struct MovedContacts {
  std::vector<int> contacts;  ///< at least one of whose blocks moves
  std::vector<int> patches;   ///< whose block a does
  std::vector<int> blocks;    ///< of those contacts and patches, moved or not
};
/// `moved`: 1 or 0 per block.
MovedContacts moved_contacts(const ContactSet& set, const std::vector<char>& moved);

/// Places points, normals, gaps and patch polygons of the contacts that moved for the given poses of all
/// blocks.
void move_contacts(std::span<const Pose> poses, const MovedContacts& moved, AnchoredContacts* contacts);

/// Gives every new contact the name and the rest gap of the nearest old one of the same sort (corner or inner
/// point) in the patch that its own continues, nearest pairs first; those left over get free numbers. Both
/// sides are expected in the same poses. Returns the contacts that came in from the side: of patches that
/// continue no old one although none of the block pair's was lost, and further points of patches that do.
std::set<ContactId> keep_identities(const AnchoredContacts& old_contacts, AnchoredContacts* contacts);

/// Where blocks have slid along each other while their joints are compressed, faces meet that have already
/// passed each other. Such contacts, `from_the_side`, begin without force: their gap counts from its present
/// value. The others lose what of their rest gap has opened.
void settle_rest_gaps(const std::set<ContactId>& from_the_side, AnchoredContacts* contacts);

}  // namespace cupola
