#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// The open part of a joint: the hull of its contact points that carry no force and have a gap above the
/// floor of lengths.
struct Crack {
  int joint = 0;            ///< index into JointWrenches::wrenches
  PlanarHull open;          ///< an area or a line
  double extent = 0.0;      ///< m, largest distance between two of its corners
  double widest_gap = 0.0;  ///< m
};

/// Joints with at least two open contact points that lie apart.
std::vector<Crack> cracks_of(const ContactTable& contacts, const JointWrenches& joints);

}  // namespace cupola
