#pragma once

#include <span>
#include <vector>

#include "assembly/model/loaded_faces.hpp"

namespace cupola {

/// A force and the point where it acts.
struct Resultant {
  Vec3 point = Vec3::Zero();  ///< m
  Vec3 force = Vec3::Zero();  ///< N
};

/// The force of a fill on a face at its centre of pressure, exact for plane faces; zero above the fill. With
/// the stress s and the outward normal n,
///     f = (integral of s dA) (max(n_z, 0) g / 9.81 + k g_z / 9.81 (n_x, n_y, 0)),
/// so that in a limit analysis of tilt or acceleration the fill weighs as the blocks do.
Resultant fill_force(const Fill& fill, const LoadedFace& face, const Vec3& gravity);

/// The parts of faces on which a fill presses that stands in columns on the faces `under` it: of all that do
/// not look up, where a column lies just before them, from its foot upwards, such as of the riser of a step.
/// As masonry covers nothing of the faces `under` it (open_parts()), closed joints, overhangs and free walls
/// have no column before them. `distance` (m): a gap up to that wide parts no column from a face, and holds
/// none.
std::vector<LoadedFace> beside_fill(const Fill& fill, std::span<const LoadedFace> faces,
                                    std::span<const LoadedFace> under, double distance);

}  // namespace cupola
