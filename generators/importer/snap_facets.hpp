#pragma once

#include <optional>
#include <vector>

#include "generators/decomposition/decompose.hpp"

namespace cupola {

/// Which facets of different blocks that face each other are faces of one joint.
struct SnapLimits {
  double distance = 0.0;  ///< m, of all their corners from one plane
  double gap = 0.0;       ///< m, between them as drawn, at their mean corners; a wider opening stays
};

/// Gives facets of different blocks that face each other a common plane, the mean of theirs weighted by area,
/// within the limits. Then moves every corner to the nearest point on the planes of its facets. Returns the
/// number of facets in common planes. Facets are found with the tolerances of `options`.
int snap_facets(std::vector<TriangleMesh>* blocks, const DecompositionOptions& options,
                const SnapLimits& limits);

/// A distance (m) for snap_facets that covers the errors of a drawing whose faces are plane and in the wrong
/// place, as rounded coordinates make them. An error is the largest distance of a corner from the common
/// plane of two facets that face each other within `largest` (m). The distance is how far apart facets are
/// drawn up to the largest error that the next one, and `largest`, exceed by a factor of two, and up to which
/// facets overlap about as far as they gape: errors do both, and openings that were drawn overlap nowhere. It
/// is a little more, so that the facets of these errors face each other within it. None if there is no such
/// error.
std::optional<double> snap_from_gaps(const std::vector<TriangleMesh>& blocks,
                                     const DecompositionOptions& options, double largest);

}  // namespace cupola
