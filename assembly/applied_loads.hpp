#pragma once

#include <vector>

#include "assembly/assembly.hpp"
#include "assembly/case/case.hpp"

namespace cupola {

/// A force on a point of a block, in the assembly's configuration.
struct PointForce {
  int block = 0;
  Vec3 point = Vec3::Zero();  ///< m, world
  Vec3 force = Vec3::Zero();  ///< N, world
};

/// Everything that a case applies but gravity on masses: lantern and top load, shared over the top faces by
/// area, at the face centroids, along gravity. Throws InputError when a load asked for finds no top face.
std::vector<PointForce> applied_loads(const Loads& loads, const Assembly& assembly);

}  // namespace cupola
