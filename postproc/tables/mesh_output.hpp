#pragma once

#include "assembly/files/mesh_file.hpp"
#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// Displaced blocks with the fields of a frame per cell. Built once per evaluation, filled per frame; the
/// evaluation must outlive it.
class DisplacedBlocks {
 public:
  explicit DisplacedBlocks(const Evaluation& evaluation);
  /// The mesh, until the next call.
  Mesh& at(const FrameEvaluation& frame);

 private:
  const Evaluation& evaluation_;
  std::vector<Vec3> vertices_;     // as built; no two blocks share one
  std::vector<int> vertex_block_;  // block of each vertex
  Mesh mesh_;
};

/// Largest number of the form 1, 2 or 5 times a power of ten that does not exceed `value` > 0.
double round_down(double value);

/// Length of a drawn force, m per N: the largest force is drawn a tenth as long as the model, rounded down to
/// 1, 2 or 5 times a power of ten.
double segment_scale(const Assembly& assembly, double largest_force);

/// joints.vtp: every joint as one point, its centre of pressure, with its wrench.
Mesh joints_mesh(const Evaluation& evaluation);

/// joint_forces.vtp: every joint as a segment from its centre of pressure along the force on its upper (or
/// second) block, to the scale in the field data.
Mesh joint_forces_mesh(const Evaluation& evaluation);

/// wrenches.vtp: the wrench on every block from the ring below as a segment from its central axis, to the
/// same scale.
Mesh wrenches_mesh(const Evaluation& evaluation);

/// thrust_lines.vtp: per meridian, the thrust line, its envelope, the lines of action, the two skins and the
/// thrust lines of the wythes, as polylines. The cell array `what` says which (LineCell).
Mesh thrust_lines_mesh(const Evaluation& evaluation);

/// ties.vtp: the bars of chains and other ties, one segment each; the cell array `chain` is the index of its
/// chain, -1: none.
Mesh ties_mesh(const Evaluation& evaluation);

/// sections.vtp: outlines of the blocks cut by sections and planes. Segments show the resultants across the
/// bed nearest to each section and the joint forces across each plane, to the same scale. The cell array
/// `what` tells segments from outlines (SectionCell).
Mesh sections_mesh(const Evaluation& evaluation);

/// cracks.vtp: open joints. One polyline per joint, around its contact points that carry no force and have a
/// gap.
Mesh cracks_mesh(const Evaluation& evaluation);

}  // namespace cupola
