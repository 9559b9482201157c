#pragma once

#include <span>
#include <vector>

#include "solver/collision/contact_detector.hpp"

namespace cupola {

// What blocks meet within a static step. Its contacts are those at its start, within the margin; what comes
// from farther away, or from aside, lies inside another block at the end.

/// m, largest motion of the points of each block between two configurations (num_blocks).
std::vector<double> ways(const CollisionModel& shapes, std::span<const Pose> from, std::span<const Pose> to);

/// Two blocks that overlap.
struct MetBlocks {
  int a = 0, b = 0;
};

/// The blocks whose parts overlap at `to` by more than the least width of a joint, and more than at `from`,
/// and have no contact in `known`, those of the step between. `detector`: updated at `to`.
std::vector<MetBlocks> met_unseen(const ContactDetector& detector, const ContactSet& known,
                                  std::span<const Pose> from, std::span<const Pose> to);

}  // namespace cupola
