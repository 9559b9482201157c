#pragma once

#include <string>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/importer/flatness.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

/// Record of an import.
struct ImportReport {
  std::vector<BlockOrigin> origins;                                  ///< per block of the assembly
  std::vector<int> parts;                                            ///< number of convex parts per block
  int already_convex = 0, by_planes = 0, as_prisms = 0, by_nef = 0;  ///< surfaces per method
  Flatness flatness;
  double facet_angle = 0.0, snap = 0.0;  ///< in force: rad, m
  bool chosen = false;                   ///< one of them follows from the data
  int snapped_facets = 0;
  int sliver_parts = 0;               ///< thinner than 1e-3 of their size
  double largest_volume_error = 0.0;  ///< sum of the parts minus the block, over the block's volume
  int ties = 0;
};

/// Reads blocks from files, repairs and checks their surfaces, and splits them into convex parts. Blocks keep
/// the order of the file; the files of a folder are read by name. Faces between parts of one block are
/// `internal`, all others `free`. `density` (kg/m3) applies to blocks without a density in the file or the
/// case. `report` may be null. Throws InputError with block, file and line.
Assembly import_blocks(const ImportedBlocks& source, double density, ImportReport* report = nullptr);

std::string to_text(const ImportReport& report);

/// The interfaces of a COMPAS file as contact points, in the CSV format of `contact: {method: file}`: one
/// point per corner, the normal from block_a towards the centroid of block_b, gap zero, and equal shares of
/// the polygon's area. Throws InputError if the file is not a COMPAS assembly or has no interfaces.
std::string contacts_csv(const ImportedBlocks& source, const Assembly& assembly, const ImportReport& report);

}  // namespace cupola
