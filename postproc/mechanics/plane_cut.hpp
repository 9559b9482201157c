#pragma once

#include <string>
#include <vector>

#include "assembly/model/applied_loads.hpp"
#include "assembly/model/section_planes.hpp"
#include "postproc/mechanics/cuts.hpp"

namespace cupola {

/// A plane through the model and what its two sides pass to each other.
///
/// A block lies on the side of its centroid, so that the cut follows the joints. "Beyond" are the free blocks
/// on the side that the normal points to.
struct PlaneCut {
  std::string name;
  Vec3 point = Vec3::Zero();          ///< m
  Vec3 normal = Vec3::UnitX();        ///< unit
  std::vector<CutPolygon> polygons;   ///< the blocks that it cuts
  std::vector<int> joints;            ///< joints across it, between free blocks; into JointWrenches::joints
  Wrench across;                      ///< on the blocks beyond through these, about `point`
  Vec3 from_supports = Vec3::Zero();  ///< N, on the blocks beyond from their supports
  Vec3 load_beyond = Vec3::Zero();    ///< N, weight and loads of the blocks beyond
  double relative_difference = 0.0;   ///< |across + from supports + load| / |load|

  bool is_beyond(const Vec3& x) const { return normal.dot(x - point) > 0.0; }
};

PlaneCut plane_cut(const CutPlane& plane, const Assembly& assembly, const JointWrenches& joints,
                   const Vec3& gravity, const std::vector<PointForce>& loads);

/// The joint's force on the block beyond the plane.
Vec3 force_beyond(const PlaneCut& cut, const Assembly& assembly, const JointWrench& joint);

}  // namespace cupola
