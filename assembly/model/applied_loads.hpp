#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/loads.hpp"

namespace cupola {

/// A force at a point of a block, in the as-built configuration, at its full value.
struct PointForce {
  static constexpr int kDeadLoad = -1;  ///< varies with Loads::dead_load_time
  static constexpr int kSteady = -2;    ///< does not vary
  int block = 0;
  Vec3 point = Vec3::Zero();  ///< m, world
  Vec3 force = Vec3::Zero();  ///< N, world
  int time = kDeadLoad;       ///< or kSteady, or index into load_times()
  bool of_moment = false;     ///< one of the forces that stand for a moment on the block
  double mass = 0.0;          ///< kg, at the point, of a lantern or top load
};

/// All loads of a case except the weight of the blocks: lantern and top load (see add_loads_on_top()); forces
/// and moments on blocks; tractions and pressures at the face centroids. Throws InputError if a load has no
/// face or block to act on.
std::vector<PointForce> applied_loads(const Loads& loads, const Assembly& assembly);

/// The part of a spread force that meets no free masonry, 0 to 1, and acts on nothing.
double share_beside(const BlockForce& load, const Assembly& assembly);

/// What PointForce::time refers to: the times of `loads.forces` and `loads.faces`; of a fill, the dead load.
std::vector<TimeFunction> load_times(const Loads& loads);
/// The factor on a force at a time (s). `of_force`: PointForce::time; `times`: load_times().
double load_factor(int of_force, const TimeFunction& dead_load_time, const std::vector<TimeFunction>& times,
                   double time);

}  // namespace cupola
