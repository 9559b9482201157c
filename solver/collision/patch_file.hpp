#pragma once

#include <string>

#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Writes the overlap polygons for ParaView (.vtp): one cell per patch with an area, with the cell data
/// `block_a`, `block_b`, `kind`, `ring`, `area_m2` and `centroid` (m). Throws SystemError.
void write_patches(const std::string& path, const ContactSet& contacts, const std::string& assembly_hash);

}  // namespace cupola
