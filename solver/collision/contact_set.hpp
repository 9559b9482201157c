#pragma once

#include <compare>
#include <vector>

#include <Eigen/Geometry>

#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// Position of a block's centroid, and its rotation relative to the assembly as generated.
struct Pose {
  Vec3 p_WB = Vec3::Zero();  ///< m
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
};

/// Identifies a contact point across steps by the features of two parts and the corner of their overlap.
struct ContactId {
  int part_a = -1, part_b = -1;
  int face_a = -1, face_b = -1;  ///< CollisionFace::id; -1 for an edge or vertex feature
  int corner = 0;                ///< index of the point within the patch
  auto operator<=>(const ContactId&) const = default;
};

/// One contact point between two blocks, a < b. The two surface points move with their blocks, so that the
/// gap and the lever arms stay correct between two detections.
struct Contact {
  ContactId id;
  int block_a = 0, block_b = 0;
  int patch = 0;                ///< index into ContactSet::patches
  Vec3 point_a = Vec3::Zero();  ///< m, world, on a's surface
  Vec3 point_b = Vec3::Zero();  ///< m, world, on b's surface
  Vec3 normal = Vec3::UnitZ();  ///< unit, from a to b
  double gap = 0.0;             ///< m, (point_b - point_a) . normal, positive when apart
  double area = 0.0;            ///< m2, tributary area
  double closed_share = 1.0;    ///< of that of a face: beyond it, faces stand open by more than the margin
  int multiplicity = 1;         ///< contact points merged into this one: 2 in a plane scene
};

/// Overlap polygon of two faces, block_a < block_b.
struct Patch {
  int block_a = 0, block_b = 0;
  JointKind kind = JointKind::other;
  int ring = 0;               ///< course of the upper block
  std::vector<Vec3> polygon;  ///< m, world, counter-clockwise about the normal from a to b
  double area = 0.0;          ///< m2
  int course = 0;             ///< in stages of construction: with which the younger block is laid
};

/// m2, of a contact point: what strengths and stresses refer to. Edges and corners have no area.
inline double bearing_area(const Contact& contact, const Patch& patch) {
  return patch.area > 0.0 ? contact.closed_share * contact.area : 0.0;
}

/// All contacts of one configuration, sorted by block pair and identity.
struct ContactSet {
  std::vector<Contact> points;
  std::vector<Patch> patches;
};

}  // namespace cupola
