#pragma once

#include <vector>

#include "assembly/model/applied_loads.hpp"

namespace cupola {

/// A force of constant direction at a point that moves with its block.
struct PointLoad {
  int block = 0;
  Vec3 p_BP_B = Vec3::Zero();        ///< m, from the centroid, axes of the block
  Vec3 force = Vec3::Zero();         ///< N, world, at factor 1
  int time = PointForce::kDeadLoad;  ///< as PointForce::time
  double mass = 0.0;                 ///< kg, at the point, which motions accelerate
};

/// All applied loads with their variation in time.
struct LoadSet {
  Vec3 gravity = Vec3::Zero();  ///< m/s2, at factor 1
  Vec3 pull = Vec3::Zero();     ///< m/s2, in addition, at any time
  TimeFunction dead_load_time;  ///< factor on gravity and on loads with time == kDeadLoad
  std::vector<PointLoad> points;
  std::vector<TimeFunction> times;

  double factor(const PointLoad& load, double time) const {
    return load_factor(load.time, dead_load_time, times, time);
  }
  Vec3 gravity_at(double time) const { return factor_at(dead_load_time, time) * gravity + pull; }
};

/// Throws InputError for a load that does not fit the assembly, such as one on a block that does not exist.
LoadSet make_loads(const Loads& loads, const Assembly& assembly);

}  // namespace cupola
