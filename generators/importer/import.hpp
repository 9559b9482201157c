#pragma once

#include <string>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

/// What the importer did, block by block.
struct ImportReport {
  std::vector<BlockOrigin> origins;                                  ///< of the assembly's blocks
  std::vector<int> parts;                                            ///< convex parts of each
  int already_convex = 0, by_planes = 0, as_prisms = 0, by_nef = 0;  ///< blocks
  int snapped_facets = 0;
  int sliver_parts = 0;               ///< thinner than 1e-3 of their own size
  double largest_volume_error = 0.0;  ///< sum of parts less block, over the block's volume
  int ties = 0;
};

/// Reads blocks that others cut, repairs and checks them, splits them into convex parts. Blocks keep the
/// order of their files (folders: files by name); faces between parts of one block are `internal`, all
/// others `free`. `density` (kg/m3) is for blocks whose file says none. `report` may be null.
/// Throws InputError naming block, file and line.
Assembly import_blocks(const ImportedBlocks& source, double density, ImportReport* report = nullptr);

std::string to_text(const ImportReport& report);

/// The interfaces of a COMPAS file as contact points, in the CSV that `contact: {method: file}` reads: one
/// point per corner, normal from block_a to block_b (the centroid of which lies on that side), no gap, the
/// polygon's area shared equally. Throws InputError when the file is none, or has no interfaces.
std::string contacts_csv(const ImportedBlocks& source, const Assembly& assembly, const ImportReport& report);

}  // namespace cupola
