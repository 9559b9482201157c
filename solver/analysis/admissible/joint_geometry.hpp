#pragma once

#include <map>
#include <utility>
#include <vector>

#include "assembly/model/thrust_joint.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// All patches between two blocks a < b.
struct BlockPair {
  Vec3 centroid = Vec3::Zero();  ///< m, world, weighted by area
  Vec3 normal = Vec3::Zero();    ///< unit, from a to b, weighted by area
  std::vector<int> contacts;     ///< indices into the contact set
};

/// The joints of an assembly as pairs of blocks.
class JointGeometry {
 public:
  JointGeometry(const Assembly& assembly, const ContactSet& contacts);

  using Pairs = std::map<std::pair<int, int>, BlockPair>;
  const Pairs& pairs() const { return pairs_; }
  /// The joint of two blocks, in either order. Throws InputError if they do not touch.
  const BlockPair& pair(int block_a, int block_b) const;
  /// Horizontal unit vector away from the axis of the vault, or from the middle of the arch, to which a free
  /// block belongs or which stands on its wall. Throws InputError for blocks without such an axis.
  Vec3 outward(const Vec3& point, int block) const;
  /// The same where the block bears on a support, see ThrustJoints::outward.
  Vec3 outward_on_support(const Vec3& point, int block) const;
  const ThrustJoints& thrust() const { return thrust_; }

 private:
  const Assembly& assembly_;
  ThrustJoints thrust_;
  Pairs pairs_;
};

}  // namespace cupola
