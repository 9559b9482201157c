#pragma once

#include <vector>

#include "assembly/export/export_model.hpp"

namespace cupola {

/// Maps the blocks as built to where they stand in a frame, per block.
std::vector<Eigen::Isometry3d> poses_of(const Assembly& assembly, const BlockTable& blocks);

/// The same where the forces of a frame balance, with its contacts. Empty: in the geometry as built, whatever
/// the displacements.
std::vector<Eigen::Isometry3d> contact_poses_of(const Assembly& assembly, const BlockTable& blocks);

/// ExportModel::yielded in a frame, whose ties from number `first` on are those of the assembly.
std::vector<double> yielded_of(const Assembly& assembly, const TieTable& ties, size_t first);

/// The assembly with its blocks and ties where they stand: the masonry as built of an analysis in the moved
/// geometry. Ties have grown by what they have yielded. Blocks no longer share vertices; courses, names and
/// axes are those of the original.
Assembly placed_assembly(const ExportModel& model);

}  // namespace cupola
