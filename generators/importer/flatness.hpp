#pragma once

#include <vector>

#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// How far the faces of the blocks of a file deviate from planes, and tolerances that follow from it.
struct Flatness {
  double warp = 0.0;           ///< m, largest distance of a corner from the mean plane of its face
  double relative_warp = 0.0;  ///< largest ratio of that distance to the size of the block
  int bent = 0;                ///< polygons warped so much that they count as several triangles
  double facet_angle = 1e-6;   ///< rad, as in ImportedBlocks
  double flat = 1e-6;          ///< times the block size, as in DecompositionOptions
};

/// Measures the polygons and chooses the tolerances:
/// - a polygon tilts by (distance of a corner from its mean plane) / (area / longest extent); up to 0.05 rad
/// it counts as
///   plane, beyond that as intended;
/// - `facet_angle` is three times the largest tilt, at least 1e-6. It is increased to leave a gap of a factor
/// of two among
///   the angles between neighbouring faces, if there is such a gap below 0.05 rad: rounding and warping make
///   small angles,
///   edges of blocks large ones;
/// - `flat` is one and a half times `relative_warp`, or `facet_angle` if that was increased.
Flatness measure_flatness(const std::vector<TriangleMesh>& meshes);

}  // namespace cupola
