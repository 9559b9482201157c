#pragma once

#include <vector>

#include "solver/collision/collision_model.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

// How fast and how far a motion is, by the points of its blocks that are fastest and have moved farthest. The
// centroid of a block that only turns stays where it is. These points are vertices.

/// m/s, of a point of a free block.
double fastest_point(const CollisionModel& shapes, const Model& model, const State& state);

/// m, of a point of a free block between two sets of poses (num_blocks).
double farthest_point(const CollisionModel& shapes, const Model& model, const std::vector<Pose>& from,
                      const std::vector<Pose>& to);

}  // namespace cupola
