#pragma once

#include "assembly/files/mesh_file.hpp"
#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The blocks where a frame puts them, with its fields per cell. Built once per assembly, filled per frame.
class DisplacedBlocks {
 public:
  explicit DisplacedBlocks(const Assembly& assembly);
  Mesh at(const FrameEvaluation& frame) const;

 private:
  const Assembly& assembly_;
  Assembly split_;                 // every block with vertices of its own
  std::vector<int> vertex_block_;  // block of each of them
  Mesh cells_;
};

/// Length of a drawn force, m per N: the largest becomes a tenth of the model's size, rounded down to 1, 2 or
/// 5 times a power of ten.
double segment_scale(const Assembly& assembly, double largest_force);

/// Every joint as a point with its wrench, and as a segment from that point along the force on its upper (or
/// second) block, drawn to the scale in the field data. The array `tip` is 1 at a segment's far end.
Mesh joints_mesh(const Evaluation& evaluation);

/// The wrench on every block from the ring below: a segment from its central axis, to the joints' scale.
Mesh wrenches_mesh(const Evaluation& evaluation);

/// Thrust lines, their envelopes and lines of action, and the skins along each meridian, as polylines told
/// apart by the cell array `what`: 0 thrust line, 1 envelope, 2 line of action, 3 intrados, 4 extrados.
Mesh thrust_lines_mesh(const Evaluation& evaluation);

/// Outlines of the blocks cut by sections and planes, with the resultants across the bed nearest to each
/// section and the joint forces across each plane as segments to the joints' scale. `what`: 0 segment, 1
/// outline.
Mesh sections_mesh(const Evaluation& evaluation);

/// Open joints: the outline of each joint's points without force and with a gap, one polyline per joint.
Mesh cracks_mesh(const Evaluation& evaluation);

}  // namespace cupola
