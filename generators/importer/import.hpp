#pragma once

#include <string>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/importer/import_report.hpp"

namespace cupola {

/// Reads blocks from files, repairs and checks their surfaces, and splits them into convex parts. Blocks keep
/// the order of the file; the files of a folder are read by name. Faces between parts of one block are
/// `internal`, all others `free`. `density` (kg/m3) applies to blocks without a density in the file or the
/// case. `report` may be null. Throws InputError with block, file and line.
Assembly import_blocks(const ImportedBlocks& source, double density, ImportReport* report = nullptr);

/// The interfaces of a COMPAS file as contact points, in the CSV format of `contact: {method: file}`: one
/// point per corner, the outward normal of the face of block_a (or inward of block_b) in whose plane it lies,
/// in no face that towards the centroid of block_b, gap zero, and equal shares of the polygon's area. Throws
/// InputError if the file is not a COMPAS assembly or has no interfaces.
std::string contacts_csv(const ImportedBlocks& source, const Assembly& assembly, const ImportReport& report);

}  // namespace cupola
