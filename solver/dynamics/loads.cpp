#include "solver/dynamics/loads.hpp"

namespace cupola {

LoadSet make_loads(const Loads& loads, const Assembly& assembly) {
  LoadSet set;
  set.gravity = loads.gravity;
  set.pull = loads.pull;
  set.dead_load_time = loads.dead_load_time;
  set.times = load_times(loads);
  for (const PointForce& load : applied_loads(loads, assembly))
    set.points.push_back(
        {load.block, load.point - assembly.blocks[load.block].centroid, load.force, load.time, load.mass});
  return set;
}

}  // namespace cupola
