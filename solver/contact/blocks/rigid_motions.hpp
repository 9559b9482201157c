#pragma once

#include <vector>

#include "solver/contact/blocks/block_matrix.hpp"

namespace cupola {

/// A common rigid motion of several blocks, expressed in the whitened unknowns of each block.
struct RigidMotions {
  std::vector<Mat6> motion;   ///< per block: linear, angular velocity about `centre` -> w
  std::vector<Vec3> centre;   ///< m, in a frame shared by touching blocks
  std::vector<double> reach;  ///< m: largest distance of a contact from the centre
  bool empty() const { return motion.empty(); }
};

/// Transforms a motion (linear and angular velocity) about the centre `from` to one about the centre `to`.
Mat6 moved_centre(const Vec3& from, const Vec3& to);

/// The motions of the blocks of a problem. The positions of neighbouring blocks relative to each other follow
/// from the levers of their contacts. This also works across the seam of a cyclic sector, where blocks have
/// frames of their own. Empty if some lever is not that of a contact in space, with orthonormal axes.
RigidMotions rigid_motions(const WhitenedProblem& problem, const ContactGraph& graph);

}  // namespace cupola
