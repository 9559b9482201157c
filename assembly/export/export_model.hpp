#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// A joint of a run, as other programs read it.
struct ExportedJoint : Joint {
  Vec3 normal = Vec3::UnitZ();  ///< unit, from block_a to block_b
  std::vector<Vec3> outline;    ///< m, counter-clockwise about the normal
  double area = 0.0;            ///< m2
  Vec3 centre = Vec3::Zero();   ///< m, centre of pressure
  Vec3 force = Vec3::Zero();    ///< N, on block_b; zero if negligible
  std::vector<Vec3> points;     ///< m, contact points
  std::vector<Vec3> forces;     ///< N, on block_b, at each of them
};

/// What is exported: the blocks, and the joints with their forces if there are results.
struct ExportModel {
  const Assembly& assembly;
  /// Where the blocks stand, applied to their vertices; empty: as built.
  std::vector<Eigen::Isometry3d> poses;
  std::vector<ExportedJoint> joints;
  double force_scale = 0.0;          ///< m per N, of drawn forces
  std::vector<double> yielded = {};  ///< m, plastic elongation of each tie of the assembly; empty: none

  Vec3 placed(int block, const Vec3& p) const { return poses.empty() ? p : poses[block] * p; }
};

/// The closed surface of a block, on vertices of its own.
struct BlockSurface {
  std::vector<Vec3> vertices;           ///< m, world, as placed
  std::vector<std::vector<int>> faces;  ///< vertex ids, counter-clockwise seen from outside
};

/// The surfaces of all blocks, by number.
std::vector<BlockSurface> block_surfaces(const ExportModel& model);

}  // namespace cupola
