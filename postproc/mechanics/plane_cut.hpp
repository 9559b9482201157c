#pragma once

#include <string>
#include <vector>

#include "assembly/model/applied_loads.hpp"
#include "assembly/model/section_planes.hpp"
#include "postproc/mechanics/cuts.hpp"

namespace cupola {

/// A plane through the model and the forces that its two sides exert on each other.
///
/// A block counts for the side on which its centroid lies, so the cut follows the joints. The blocks "beyond"
/// are the free blocks on the side to which the normal points, but for those whose centroid lies on the plane;
/// those that a stage leaves out are supports.
struct PlaneCut {
  std::string name;
  Vec3 point = Vec3::Zero();          ///< m
  Vec3 normal = Vec3::UnitX();        ///< unit
  std::vector<CutPolygon> polygons;   ///< outlines of the parts that it cuts
  std::vector<int> joints;            ///< between free blocks on either side; into JointWrenches::wrenches
  Wrench across;                      ///< of these joints on the blocks beyond, about `point`
  Vec3 from_ties = Vec3::Zero();      ///< N, of the ties across the plane on the blocks beyond
  Vec3 from_supports = Vec3::Zero();  ///< N, of the supports on the blocks beyond
  Vec3 load_beyond = Vec3::Zero();    ///< N, weight of the blocks beyond and loads on them
  double relative_difference = 0.0;   ///< |across + from_ties + from_supports + load_beyond| / |load_beyond|
};

/// Without the polygons. `left_out`: as in ring_sums().
PlaneCut plane_cut(const CutPlane& plane, const Assembly& assembly, const JointWrenches& joints,
                   const Vec3& gravity, const std::vector<PointForce>& loads, const TieTable& ties = {},
                   const std::vector<bool>& left_out = {});

/// The force of a joint across the plane on the block beyond.
Vec3 force_beyond(const PlaneCut& cut, const Assembly& assembly, const JointWrench& joint);

}  // namespace cupola
