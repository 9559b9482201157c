#pragma once

#include <optional>
#include <vector>

#include "postproc/mechanics/thrust_line.hpp"

namespace cupola {

/// Share of a block or facet that is the rounding of its corners.
inline constexpr double kCornerRounding = 1e-9;

/// What one thrust line follows: a meridian, or none in an arch, and a wythe, or none for the whole
/// thickness.
struct Route {
  Sheet axis;
  double width = 0.0;              ///< rad, of the strip
  std::optional<double> meridian;  ///< rad
  std::optional<int> wythe;
};

/// False where a bed runs through a block.
bool stands_on(const ThrustInput& in, int block, int bed);

/// The bed and base joints of a block on a bed: on one that closes a stack those over it, else those under it.
std::vector<const JointWrench*> joints_on(const ThrustInput& in, int block, int bed);

/// What crosses a bed in the strip under (on a bed that closes a stack over) one block, or at one joint of a
/// stone round the axis.
struct Strand {
  BlockBed block;  ///< of a joint: with its own range of azimuths
  bool of_joint = false;
  double share = 1.0;                      ///< of it, in the strip
  std::vector<const JointWrench*> joints;  ///< in the wythe
};

/// The strands on a bed with a share in the strip, in the order of their blocks.
std::vector<Strand> strands_on(const ThrustInput& in, int bed, const Route& route);

}  // namespace cupola
