#pragma once

#include <functional>
#include <vector>

#include "tests/extremes/extreme_scene.hpp"

namespace cupola {

/// Resultant of some contact points, known exactly.
struct KnownForce {
  std::vector<int> rows = {};   ///< contact points of the frame
  std::vector<int> signs = {};  ///< +1: the force on block b counts, -1: on block a
  Vec3 force = Vec3::Zero();    ///< N, exact
  /// Blocks whose equilibrium gives the force, for resultants that follow from statics alone; 0 otherwise.
  /// Then |F - exact| <= num_blocks * (largest unbalanced force).
  int num_blocks = 0;
  /// Only the component along this unit vector is known; zero: all of the force.
  Vec3 along = Vec3::Zero();
};

/// Errors of known resultants. Empty if the status is not `stable`.
TrueError compare(const Scene& scene, const Summary& summary, const Frame& frame,
                  const std::vector<KnownForce>& known);

/// The force on every set {blocks of ring >= k} from below: minus their weight and the given forces on them.
/// Rings are those of the blocks; every contact lies within a ring or between successive rings.
std::vector<KnownForce> weight_above(const Scene& scene, const Frame& frame);

/// Resultant of the points between two blocks that `counts` selects; it acts on block b, a < b.
KnownForce between(const Frame& frame, int block_a, int block_b, const Vec3& force,
                   const std::function<bool(const Vec3& point)>& counts = {});

/// Truth of rows whose forces are the weight above.
TrueError carries_weight_above(const Scene& scene, const Summary& summary, const Frame& frame);

/// Truth of rows whose forces solve_exact_statics() gives. If it finds none for a stable structure, or some
/// for a moving one, `refuted` says so.
TrueError equals_exact_statics(const Scene& scene, const Summary& summary, const Frame& frame);

}  // namespace cupola
