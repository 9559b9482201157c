#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/collision/joint_patch.hpp"
#include "solver/collision/proximity.hpp"

namespace cupola {

/// Options of the narrow phase of the paper (section 2.3).
struct PerturbedGjkOptions {
  /// m, eps_m, >= 0: parts are shrunk by this margin and swept by a sphere of this radius, which rounds their
  /// edges. Must be below half the thickness of the thinnest part. 0: 1 % of the smallest free block.
  double margin = 0.0;
  int perturbations = 16;  ///< >= 1: queries with a small rotation, in addition to the unperturbed one
  double angle = 0.01;     ///< rad, > 0: largest rotation
  std::uint64_t seed = 1;  ///< of the rotations
  int keep = 4;            ///< >= 1: points kept per pair of parts
};

/// Finds contacts by running GJK on shrunk parts under small random rotations.
///
/// Each query gives one pair of nearest points P'_A, P'_B of the shrunk parts. Moved by the margin along the
/// line between them they are P_A, P_B, whose gap can be as small as -2 margin. Where two faces touch, the
/// rotations move the nearest points to different corners; the points that span the largest polygon are kept.
/// The normal is that of the rotated query, which reproduces the noise that the paper reports. The rotations
/// depend only on the seed and the pair of parts.
class PerturbedGjk {
 public:
  /// Throws InputError with the block when a part is thinner than twice the margin.
  PerturbedGjk(const CollisionModel& model, const PerturbedGjkOptions& options);

  /// Returns nothing when the distance of the parts exceeds half the margin plus `reach` (m), when one of the
  /// nearest faces is `internal`, or when the parts overlap by more than twice the margin.
  std::optional<JointPatch> find(const CollisionModel& model, int part_a, int part_b,
                                 const Eigen::Isometry3d& pose_ab, double reach) const;

  double margin() const { return options_.margin; }  ///< m, with the default filled in

 private:
  PerturbedGjkOptions options_;
  std::vector<ConvexBody> cores_;  ///< one per part, axes of its block
};

/// Indices of up to `keep` points that span a large polygon, chosen greedily: the two points farthest apart,
/// then in turn the point that adds the most area. Points within `tolerance` (m) of a chosen one are skipped.
std::vector<int> largest_patch(std::span<const Vec2> points, int keep, double tolerance);

}  // namespace cupola
