#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// The outline along which a plane cuts a convex part.
struct CutPolygon {
  int part = 0, block = 0, ring = 0;
  std::vector<Vec3> outline;  ///< m
};

/// Outlines of all parts that a plane cuts. Parts that the plane only touches are left out, and those
/// of blocks in `left_out`.
std::vector<CutPolygon> cut_by_plane(const Assembly& assembly, const Plane& plane,
                                     const std::vector<bool>& left_out = {});

/// Force of one ring across a meridian half-plane: the component along the ring that the blocks on the side
/// of greater azimuth receive from the others, compression positive.
///
/// A block on the plane, as a key stone, lies before it at azimuths from 0 up to 180 degrees and beyond it at
/// the others; a joint at the axis counts half. Opposite half-planes thus add up to the plane.
struct HoopRow {
  int ring = 0;
  double height = 0.0;      ///< m, mean height of the joints crossed; without any, of a tie
  double head_force = 0.0;  ///< N, through head joints
  double bed_force = 0.0;   ///< N, through bed joints, by friction and by their inclination
  double tie_force = 0.0;   ///< N, of ties; negative in tension

  double sum() const { return head_force + bed_force + tie_force; }
};

/// Forces across the meridian at an azimuth about the axis of the stack with the course `ring`, one row per
/// course of it that has joints or taut ties across the meridian. A tie counts for the course of its block a.
std::vector<HoopRow> hoop_forces(const Assembly& assembly, const JointWrenches& joints, double azimuth_deg,
                                 const TieTable& ties = {}, int ring = 0);

}  // namespace cupola
