#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assembly/base/named_enum.hpp"

namespace cupola {

/// Density of some imported blocks.
struct BlockDensity {
  std::vector<std::string> blocks;  ///< names
  double density = 0.0;             ///< kg/m3, > 0
};

/// Imported blocks, instead of a surface and a bond.
struct ImportedBlocks {
  enum class Format : std::uint8_t { automatic, obj, off, stl, ply, compas, bricks };
  enum class UpAxis : std::uint8_t { z, y };
  /// Blocks that are fixed besides those that are named or flagged. `lowest`: with a corner in the lowest
  /// plane of the model. `one_neighbour`: with a single joint, as the ends of an arch have.
  enum class SupportRule : std::uint8_t { none, lowest, one_neighbour };

  std::string path;                       ///< file, or folder of files
  Format format = Format::automatic;      ///< automatic: by the file name extension
  std::optional<double> metres_per_unit;  ///< > 0; none: 1, if the size of the model is that of a structure
  UpAxis up = UpAxis::z;                  ///< of the file; y up is rotated to z up about x
  std::vector<std::string> supports;      ///< names of fixed blocks
  bool flagged_supports = true;           ///< also fix blocks that the file marks as fixed
  std::optional<double> fixed_below;      ///< m: also fix blocks whose centroid lies below this z
  SupportRule fixed_by = SupportRule::none;
  std::optional<Eigen::Vector3d>
      axis;  ///< m, a point of the vertical axis from which `outward` points; none: from the supports
  std::vector<BlockDensity>
      densities;              ///< override those of the file, which override the material of the case
  std::string springs, rods;  ///< files of ties, brick CSV; "" for none
  /// rad, > 0: neighbouring triangles form a facet if their normals agree within this and their vertices lie
  /// within this times the block size of one plane.
  /// None: chosen from the deviations of the faces from planes (generators/importer/flatness.hpp).
  std::optional<double> facet_angle;
  /// m: facing facets within this distance of a common plane are moved into it; 0: none; without a value: 4
  /// times the deviation of the faces from planes.
  std::optional<double> snap;
};
constexpr auto enum_names(ImportedBlocks::Format) {
  return std::array{"automatic", "obj", "off", "stl", "ply", "compas", "bricks"};
}
constexpr auto enum_names(ImportedBlocks::UpAxis) {
  return std::array{"z", "y"};
}
constexpr auto enum_names(ImportedBlocks::SupportRule) {
  return std::array{"none", "lowest", "one_neighbour"};
}

}  // namespace cupola
