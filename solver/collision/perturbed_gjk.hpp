#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/collision/joint_patch.hpp"
#include "solver/collision/proximity.hpp"

namespace cupola {

/// The paper's narrow phase (section 2.3).
struct PerturbedGjkOptions {
  /// m, eps_m, >= 0: how far shapes are shrunk and swept again. Must stay below half the thinnest part.
  /// Edges are rounded by as much. 0: 1 % of the smallest free block.
  double margin = 0.0;
  int perturbations = 16;  ///< >= 1: queries with a small rotation, besides the unperturbed one
  double angle = 0.01;     ///< rad, > 0: largest rotation
  std::uint64_t seed = 1;  ///< of the rotations
  int keep = 4;            ///< >= 1: points kept, those that span the largest patch
};

/// Finds contacts by running GJK on shrunk parts under small random rotations.
///
/// Every query gives one pair of nearest points P'_A, P'_B; offset by margin along the line between them they
/// are P_A, P_B, with a gap down to -2 margin. Where two faces lie on each other the rotations send the
/// nearest points to one corner or another; of all of them those are kept that span the largest polygon. The
/// normal is that of the query, rotation and all: the noise that the paper reports, kept on purpose. The
/// rotations depend on the seed and the pair of parts alone.
class PerturbedGjk {
 public:
  /// Throws InputError naming the block whose part is thinner than twice the margin.
  PerturbedGjk(const CollisionModel& model, const PerturbedGjkOptions& options);

  /// None when the parts are further apart than half the margin and `reach` (m), when their nearest faces are
  /// `internal`, or when they overlap by more than twice the margin.
  std::optional<JointPatch> find(const CollisionModel& model, int part_a, int part_b,
                                 const Eigen::Isometry3d& pose_ab, double reach) const;

  double margin() const { return options_.margin; }  ///< m, in force

 private:
  PerturbedGjkOptions options_;
  std::vector<ConvexBody> cores_;  ///< one per part, axes of its block
};

/// Indices of the `keep` points that span the largest polygon, chosen one by one: the farthest pair, then
/// whichever point adds most area. Points nearer than `tolerance` (m) to a chosen one are left out.
std::vector<int> largest_patch(std::span<const Vec2> points, int keep, double tolerance);

}  // namespace cupola
