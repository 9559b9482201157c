#pragma once

#include <vector>

#include "solver/contact/blocks/block_matrix.hpp"

namespace cupola {

/// What a common rigid motion of several blocks is to each of them, in its whitened unknowns.
struct RigidMotions {
  std::vector<Mat6> motion;   ///< per block: linear, angular velocity about `centre` -> w
  std::vector<Vec3> centre;   ///< m: points of a frame that touching blocks share
  std::vector<double> reach;  ///< m: no contact is farther from the centre
  bool empty() const { return motion.empty(); }
};

/// A motion about another centre: velocities about `to` from those about `from`.
Mat6 moved_centre(const Vec3& from, const Vec3& to);

/// The motions of the blocks of a problem, L L^T = M per block. Where each block lies to its neighbours is
/// read off the levers D of their contacts, so that it also holds across the seam of a cyclic sector, whose
/// blocks keep frames of their own. Empty when some D is not that of a contact in space: three orthonormal
/// directions and their moments.
RigidMotions rigid_motions(const ContactProblem& problem, const ContactGraph& graph,
                           const std::vector<Mat6>& L);

}  // namespace cupola
