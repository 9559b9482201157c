#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"

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
  double shortest_edge = 0.0;
  int islands = 0;  ///< connected pieces of the contact graph
  std::vector<int> blocks_without_joint;
};

/// Bounds that a generated model keeps, as multiples of its size (largest extent), so that they follow the
/// rounding of its coordinates.
struct ModelTolerances {
  double plane = 1e-13;    ///< convexity and planarity, x model size
  double overlap = 1e-11;  ///< depth of an overlap, x model size (1e-9 m on the 50 m dome, as asked)
};

/// Measures the model and checks it: blocks closed, outward, free of self-intersections (CGAL, exact
/// predicates), parts convex with plane faces, no two blocks overlap, every block has a joint.
/// Throws InputError naming the block and the measure that breaks its bound.
ModelReport check_model(const Assembly& assembly, const ModelTolerances& tolerances = {});

std::string to_text(const ModelReport& report);

}  // namespace cupola
