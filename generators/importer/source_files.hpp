#pragma once

#include <string>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "generators/importer/block_mesh.hpp"

namespace cupola {

/// The format of the case, or that of the ending of the file; `automatic` if it is unknown.
ImportedBlocks::Format format_of(const ImportedBlocks& source, const std::string& path);

/// Reads the blocks of a file, or of the files of a folder in the order of their names. Throws InputError.
std::vector<RawBlock> read_all(const ImportedBlocks& source);

/// Converts a point from the units and axes of the file to metres with z up.
Vec3 to_world(const ImportedBlocks& source, const Vec3& p);

/// Converts coordinates to metres with z up and applies the densities of the case. Throws InputError if two
/// blocks have the same name.
void place_in_world(const ImportedBlocks& source, std::vector<RawBlock>* blocks);

}  // namespace cupola
