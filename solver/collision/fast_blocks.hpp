#pragma once

#include <optional>
#include <span>

#include "solver/collision/collision_model.hpp"

namespace cupola {

/// Two blocks that may pass each other in a step although no contact of them is found.
struct FastPair {
  int block = 0, other = 0;
  double way = 0.0;      ///< m, of `block`
  double longest = 0.0;  ///< s, step in which contacts between them are found

  template <class Archive>
  friend void visit(Archive& archive, FastPair& x) {
    archive(x.block, x.other, x.way, x.longest);
  }
};

/// Contacts are sought as far from a block as it moves in the step, but not farther than its radius
/// (ContactDetector::update()), and at the configuration after the share `middle` of the step. Of the pairs
/// whose boxes meet on their way, and which start farther apart or are beyond half the thickness of the
/// thinner block by then, the one that demands the shortest step. None: contacts of all pairs are found.
///
/// `from`, `to`: poses at the ends of a step of h (s).
std::optional<FastPair> fast_pair(const CollisionModel& shapes, std::span<const Pose> from,
                                  std::span<const Pose> to, double h, double middle);

}  // namespace cupola
