#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// A straight tie between points of two blocks, modelled as a frictionless contact along its axis with gap
///
///     phi = L0 - L   (positive when slack)
///
/// and compliance 1/stiffness. A strut has phi = L - L0 and pushes when it is shorter than L0.
struct Tie {
  int block_a = 0, block_b = 0;                       ///< a < b
  Vec3 p_AP_A = Vec3::Zero(), p_BP_B = Vec3::Zero();  ///< m, from the centroids, axes of the blocks
  double natural_length = 0.0;                        ///< L0, m
  double compliance = 0.0;                            ///< m/N, > 0
  bool strut = false;                                 ///< resists shortening instead of lengthening
};

/// Position of a tie: its ends, and the direction of its force on b.
struct TieGeometry {
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< m, world
  /// Unit, used like a contact normal: u_n > 0 slackens the tie, and a positive force acts on b along it.
  Vec3 normal = Vec3::UnitZ();
  double gap = 0.0;  ///< m, positive when slack
};
TieGeometry tie_geometry(const Tie& tie, const std::vector<Pose>& poses);

/// The ties of the case and of the assembly. A rigid rod gives a tie and a strut. Throws InputError for
/// blocks or rings that do not exist, and for ends that coincide.
std::vector<Tie> make_ties(const Case& scene, const Assembly& assembly);

}  // namespace cupola
