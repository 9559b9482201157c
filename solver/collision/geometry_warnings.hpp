#pragma once

#include <string>
#include <vector>

#include "solver/collision/contact_detector.hpp"

namespace cupola {

/// One sentence for each pair of blocks, or block, whose geometry contact detection cannot serve well:
///
/// - blocks that overlap by more than 1e-6 of the smallest block as built: their contacts start compressed,
///   and a block that lies inside another has none;
/// - joints narrower than 1e-3 of the smallest block, which are left out;
/// - parts thinner than the margin, through which contacts reach from the wrong side.
///
/// Throws InputError where two blocks overlap by more than the margin: they contradict each other, and forces
/// that push them apart would mean nothing.
std::vector<std::string> geometry_warnings(const Assembly& assembly, const DetectionOptions& options);

}  // namespace cupola
