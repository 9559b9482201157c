#pragma once

#include <string>

#include "assembly/export/export_model.hpp"

namespace cupola {

// One function per format, each in a file of its own. Coordinates are metres.

/// glTF 2.0 with its data inside, y up: x, y, z of the model become x, z, -y. One node per block, named like
/// the block, with its origin at the centroid, and one node `forces` with an arrow per joint. Coordinates are
/// single precision, relative to the origin of their node.
std::string gltf_text(const ExportModel& model);

/// Wavefront OBJ, z up: one object per block, all digits.
std::string obj_text(const ExportModel& model);

/// COMPAS assembly (compas_assembly.datastructures/Assembly), z up, all digits. Nodes are the blocks with the
/// attributes `name` and `is_support`; edges the joints from block_a to block_b, with one interface each.
std::string compas_text(const ExportModel& model);

/// One row per block: number, name, place in the bond, mass properties. Units end the names of the columns.
std::string blocks_csv(const ExportModel& model);

}  // namespace cupola
