#pragma once

#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// How far the farthest point of each free block has moved, m (num_blocks; 0 of fixed blocks): from where it
/// was built, or from where a part of the move of one support, between none and all, would have carried it.
/// Of these supports and parts the one counts that the block follows best. The points are vertices.
///
/// `displacement` (m) of the centroids, relative to the ground, and `quaternion_wxyz`: of all blocks, fixed
/// ones too (num_blocks).
std::vector<double> distances_moved(const Assembly& assembly, std::span<const Vec3> displacement,
                                    std::span<const Eigen::Vector4d> quaternion_wxyz);

}  // namespace cupola
