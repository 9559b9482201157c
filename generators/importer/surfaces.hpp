#pragma once

#include <vector>

#include "assembly/case/geometry.hpp"
#include "generators/decomposition/decompose.hpp"
#include "generators/importer/block_mesh.hpp"
#include "generators/importer/import_report.hpp"

namespace cupola {

/// Repaired surfaces. A block given by point clouds has one per part, other blocks have one.
struct Surfaces {
  std::vector<TriangleMesh> meshes;
  std::vector<int> block;  // per mesh
};

/// Throws InputError with the defects of all blocks at once.
Surfaces repair_all(const std::vector<RawBlock>& blocks, ImportReport* report);

/// m3, of each block as drawn: each polygon as a fan about the mean of its corners, which for four corners
/// bounds the volume of the bilinear face.
std::vector<double> drawn_volumes(const Surfaces& surfaces, size_t num_blocks);

/// The tolerances of the case, or those that follow from the surfaces.
DecompositionOptions choose_tolerances(const ImportedBlocks& source, const std::vector<TriangleMesh>& meshes,
                                       ImportReport* report);

}  // namespace cupola
