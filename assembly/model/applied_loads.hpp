#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/loads.hpp"

namespace cupola {

/// A force on a point of a block, in the assembly's configuration, at its full value.
struct PointForce {
  static constexpr int kDeadLoad = -1;  ///< varies with time as gravity does
  int block = 0;
  Vec3 point = Vec3::Zero();  ///< m, world
  Vec3 force = Vec3::Zero();  ///< N, world
  int time = kDeadLoad;       ///< index into load_times()
};

/// Everything that a case applies but gravity on masses: lantern and top load, shared over the top faces by
/// area, at the face centroids, along gravity; forces on blocks; tractions and pressures on faces, at the
/// face centroids. Throws InputError when a load finds no face or block to act on.
std::vector<PointForce> applied_loads(const Loads& loads, const Assembly& assembly);

/// The time functions that PointForce::time counts: of `loads.forces`, then of `loads.faces`.
std::vector<TimeFunction> load_times(const Loads& loads);

}  // namespace cupola
