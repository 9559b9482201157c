#pragma once

#include "solver/collision/contact_set.hpp"
#include "solver/collision/patch_quadrature.hpp"

namespace cupola {

/// Scales joints about the centroids of all faces between two blocks: distances by `extent`, areas by its
/// square. A face that is open in part, as at a hinge, bears only where it is closed: reduced, it has
/// `sampling` of what its closed part and the reduced face share; enlarged, its closed points scale like
/// those of others. True if there are such faces.
bool scale_joints(const Assembly& assembly, double extent, const PatchSampling& sampling,
                  ContactSet* contacts);

}  // namespace cupola
