#pragma once

#include <span>

#include "solver/collision/patch_contacts.hpp"

namespace cupola {

/// Two blocks that may touch, a < b, and their configuration when their contacts were last computed.
struct TrackedPair {
  int a = 0, b = 0;
  Pose X_AB;            ///< centroid (m) and orientation of b in the axes of a
  double travel = 0.0;  ///< m, by which the margin of their contacts exceeded that of blocks at rest
  bool stale = true;    ///< the contacts must be computed, or computed again
};

/// Pose of b in the axes of a. Subtracting the centroids first keeps the precision far from the origin.
Pose relative_pose(const Pose& a, const Pose& b);

/// Upper bound of the distance (m) by which a point within `radius` of the centroid has moved.
double motion_bound(const Pose& from, const Pose& to, double radius);

/// Upper bound of the distance (m) by which points of two blocks within their radii have moved relative to
/// each other.
double relative_motion(const Pose& from, const Pose& to, double radius_a, double radius_b);

/// Gives pairs the configuration of the same pair in `old`. The other pairs are new and stay stale. Both are
/// sorted.
void take_configurations(std::span<const TrackedPair> old, std::span<TrackedPair> pairs);

/// Replaces the contacts of stale pairs by those in `fresh`, and removes those of pairs that are not listed.
/// All three are sorted by pair.
void replace_contacts(std::span<const TrackedPair> pairs, AnchoredContacts fresh, AnchoredContacts* contacts);

}  // namespace cupola
