#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// A straight tie between points of two blocks: one frictionless contact row along it, with the gap
/// phi = L0 - L (positive when slack) and the compliance 1/stiffness. A strut is the mirror image: it pushes
/// when shorter than L0.
struct Tie {
  int block_a = 0, block_b = 0;                       ///< a < b
  Vec3 p_AP_A = Vec3::Zero(), p_BP_B = Vec3::Zero();  ///< m, from the centroids, in the blocks' axes
  double natural_length = 0.0;                        ///< L0, m
  double compliance = 0.0;                            ///< m/N, > 0
  bool strut = false;                                 ///< resists shortening instead of lengthening
};

/// Where a tie is: its ends and the direction in which its force acts on b.
struct TieGeometry {
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< m, world
  Vec3 normal =
      Vec3::UnitZ();  ///< unit, as a contact normal: u_n > 0 slackens, a positive force acts on b along it
  double gap = 0.0;   ///< m, positive when slack
};
TieGeometry tie_geometry(const Tie& tie, const std::vector<Pose>& poses);

/// The ties of the case and of the assembly. A rigid rod becomes a tie and a strut. Throws InputError for a
/// block or ring that does not exist, or ends that coincide.
std::vector<Tie> make_ties(const Case& scene, const Assembly& assembly);

}  // namespace cupola
