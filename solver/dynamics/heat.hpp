#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Expansion of a block under a change of temperature T + g . x: a point at x from `centre` moves by
///
///     alpha [(T + g . x) x - |x|^2 g / 2],
///
/// whose strain is alpha (T + g . x) in all directions and whose rotation about the centre is zero (B. A.
/// Boley, J. H. Weiner, Theory of Thermal Stresses, 1960: a linear field leaves a free body without stress).
struct BlockExpansion {
  Vec3 centre = Vec3::Zero();    ///< m, from the centroid of the block, its own axes
  double strain = 0.0;           ///< alpha T
  Vec3 gradient = Vec3::Zero();  ///< 1/m, alpha g, axes of the block
  TimeFunction time;
};

/// Expansions of the blocks. As built, before the start of a run at the time 0, no block is heated.
class HeatedBlocks {
 public:
  HeatedBlocks() = default;
  /// Throws InputError for regions without blocks, and for a growth along the normal of blocks without an
  /// extrados.
  HeatedBlocks(const Case& scene, const Assembly& assembly);

  bool empty() const { return of_block_.empty(); }
  /// m, world, by which the point b of a contact, or of a tie, moves away from its point a at `time` (s). What
  /// belongs to no block (-1), stays.
  Vec3 separation(const std::vector<Pose>& poses, const Contact& contact, double time) const;
  /// The same at the start of a step.
  Vec3 separation_before(const std::vector<Pose>& poses, const Contact& contact, double time) const {
    return time > 0.0 ? separation(poses, contact, time) : Vec3::Zero();
  }
  /// The contacts with the gaps between the heated faces at the start of a step.
  ContactSet heated(ContactSet contacts, const std::vector<Pose>& poses, double time) const;
  bool stays_in_plane() const;  ///< no growth along y

 private:
  void add(int block, const BlockExpansion& expansion) { of_block_[block].push_back(expansion); }
  Vec3 displacement(int block, const Pose& pose, const Vec3& point, double time) const;

  std::vector<std::vector<BlockExpansion>> of_block_;  // (num_blocks), or empty
};

}  // namespace cupola
