#pragma once

#include <optional>
#include <vector>

#include "generators/decomposition/decompose.hpp"

namespace cupola {

/// Gives facets of different blocks that face each other a common plane, the mean of theirs weighted by area,
/// if all their corners lie within `distance` (m) of it. Then moves every corner to the nearest point on the
/// planes of its facets. Returns the number of facets in common planes. Facets are found with the tolerances
/// of `options`.
int snap_facets(std::vector<TriangleMesh>* blocks, const DecompositionOptions& options, double distance);

/// A distance (m) for snap_facets that covers the errors of a drawing whose faces are plane and in the wrong
/// place, as rounded coordinates make them. An error is the largest distance of a corner from the common
/// plane of two facets that face each other within `largest` (m). The distance is twice the largest error
/// that the next one, and `largest`, exceed by a factor of two, and up to which facets overlap about as far
/// as they gape: errors do both, and openings that were drawn overlap nowhere. None if there is no such
/// error.
std::optional<double> snap_from_gaps(const std::vector<TriangleMesh>& blocks,
                                     const DecompositionOptions& options, double largest);

}  // namespace cupola
