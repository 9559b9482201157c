#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "generators/importer/courses.hpp"
#include "generators/importer/flatness.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

/// Record of an import.
struct ImportReport {
  /// Of the block size: smaller deviations from planes are rounding of doubles.
  static constexpr double kRoundedWarp = 1e-9;

  std::vector<BlockOrigin> origins;                                  ///< per block of the assembly
  std::vector<int> parts;                                            ///< number of convex parts per block
  int already_convex = 0, by_planes = 0, as_prisms = 0, by_nef = 0;  ///< surfaces per method
  std::vector<int> solids;      ///< per block, that its surface bounds; 1 for a block of given parts
  std::string separate_solids;  ///< the free blocks with several of them; empty: none
  Flatness flatness;
  double facet_angle = 0.0, snap = 0.0;                          ///< in force: rad, m
  double largest_gap = std::numeric_limits<double>::infinity();  ///< m, that a chosen `snap` closes
  bool chosen = false;                                           ///< one of them follows from the data
  std::optional<double> snap_of_gaps;  ///< m, from the gaps and overlaps between faces
  int snapped_facets = 0;
  int sliver_parts = 0;               ///< thinner than 1e-3 of their size
  double largest_volume_error = 0.0;  ///< sum of the parts minus the block, over the block's volume
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< m, extents of the model
  int doubled_faces = 0;                         ///< dropped
  /// m3, of all blocks as drawn: the exact volume of four-sided faces that are warped (bilinear), fans about
  /// the mean of the corners of other polygons.
  double drawn_volume = 0.0;
  double volume_of_parts = 0.0;  ///< m3, from which masses follow
  int most_changed_block = 0;    ///< whose volume differs most from that of its drawing
  double most_changed = 0.0;     ///< by this share of it
  double unusual_size = 0.0;     ///< m, mean size of the blocks if the unit is doubtful
  int ties = 0;
  bool uses_material = false;       ///< a free block has no density of its own
  std::string doubt_of_axes;        ///< why another axis may be upward; empty: no doubt
  std::vector<int> course_numbers;  ///< per block, as in the file; kNoCourse: none; empty: the file has none
  CourseReport courses;
};

std::string to_text(const ImportReport& report);

/// What the user must know about the import, one sentence each.
std::vector<std::string> warnings_of(const ImportReport& report);

}  // namespace cupola
