#pragma once

#include <span>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// The convex parts of a block.
std::span<const Part> parts_of_block(const Assembly& assembly, int block);

/// How far a point lies outside the faces of a convex part, m; negative inside.
double distance_from_part(const Assembly& assembly, const Part& part, const Vec3& point);

/// The same for the nearest part of a block.
double distance_from_block(const Assembly& assembly, int block, const Vec3& point);

}  // namespace cupola
