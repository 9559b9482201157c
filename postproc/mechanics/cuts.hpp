#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// A convex part cut by a plane.
struct CutPolygon {
  int part = 0, block = 0, ring = 0;
  std::vector<Vec3> outline;  ///< m
};

/// Everything of the assembly that a plane cuts; parts that it only touches give nothing.
std::vector<CutPolygon> cut_by_plane(const Assembly& assembly, const Plane& plane);

/// Forces across the meridian half-plane at an azimuth, by course: what the blocks on its positive side
/// receive from the others along the ring, compression positive.
struct HoopRow {
  int ring = 0;
  double height = 0.0;      ///< m, mean of the joints' heights
  double head_force = 0.0;  ///< N, through head joints
  double bed_force = 0.0;   ///< N, through beds, by friction and their inclination
};
std::vector<HoopRow> hoop_forces(const Assembly& assembly, const JointWrenches& joints, double azimuth_deg);

}  // namespace cupola
