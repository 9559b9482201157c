#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/base/error.hpp"
#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// What every generated model is measured for, with the bounds it must keep. Lengths in m, volumes in m3.
struct ModelReport {
  int num_blocks = 0;  ///< without supports
  int num_supports = 0;
  int num_parts = 0;          ///< of the blocks without supports
  int num_joints = 0;         ///< pairs of blocks that share a face patch, supports included
  double volume = 0.0;        ///< sum over the blocks without supports
  double parts_volume = 0.0;  ///< sum over their parts
  double smallest_block = 0.0, largest_block = 0.0;
  std::optional<double> shell_volume;  ///< of the smooth shell, where a closed form is known
  double max_convexity_error = 0.0;    ///< largest height of a part's vertex above one of its face planes
  double max_planarity_error = 0.0;    ///< largest distance of a face's vertex from the face's plane
  double max_overlap = 0.0;            ///< largest depth by which parts of two blocks overlap; <= 0: none
  double max_joint_gap = 0.0;          ///< largest distance of the planes of two faces that share a joint
  double shortest_edge = 0.0;
  int islands = 0;                        ///< connected pieces of the graph of joints and ties
  std::vector<int> blocks_without_joint;  ///< that no tie holds either
};

/// Where a block came from, for messages; generated blocks are called by their number.
struct BlockOrigin {
  std::string name;
  FileLocation where;
};

/// Bounds that a model must keep.
struct ModelTolerances {
  double plane = 0.0;         ///< m, convexity and planarity
  double overlap = 0.0;       ///< m, depth of an overlap
  double joint_gap = 0.0;     ///< m, faces nearer than this share a joint
  double joint_angle = 0.0;   ///< rad, so do they when opposed within this
  bool part_by_part = false;  ///< parts share no vertices: each is checked as a closed surface of its own
};

/// For generated blocks: rounding of the coordinates, 1e-13 of the model's size for planes and 2e-11 of it
/// (1e-9 m on the 50 m dome) for overlaps.
ModelTolerances generated_tolerances(const Assembly& assembly);

/// For imported blocks: what the case accepts; planes within 1e-5, or facet_angle if more, of the model's
/// size.
ModelTolerances imported_tolerances(const Assembly& assembly, const ImportedBlocks& source);

/// Measures the model and checks it: blocks closed, outward, free of self-intersections (CGAL, exact
/// predicates), parts convex with plane faces, no two blocks overlap. Throws InputError naming the block and
/// the measure that breaks its bound. `origins`: of all blocks, or none.
ModelReport check_model(const Assembly& assembly, const ModelTolerances& tolerances,
                        std::span<const BlockOrigin> origins = {});

std::string to_text(const ModelReport& report, std::span<const BlockOrigin> origins = {});

}  // namespace cupola
