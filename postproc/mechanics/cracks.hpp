#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// The open part of a joint: the hull of its contact points that do not press and are open by more than the
/// floor of lengths, with strength beyond their elastic elongation. A crack may still pull, as in softening.
struct Crack {
  int joint = 0;            ///< index into JointWrenches::wrenches
  PlanarHull open;          ///< an area, a line or a point
  double widest_gap = 0.0;  ///< m
};

/// Joints with open contact points.
std::vector<Crack> cracks_of(const ContactTable& contacts, const JointWrenches& joints);

}  // namespace cupola
