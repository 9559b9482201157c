#pragma once

#include <optional>

#include "assembly/case/geometry.hpp"
#include "postproc/mechanics/thrust_line.hpp"

namespace cupola {

/// How much more the ribs of a vault carry than the middle of its sails.
///
/// On every bed the resultants r of strips one block wide are summed over all ribs and over all mid-sails;
/// their ratio is averaged over the beds. The beds are the lowest ones that make up whole periods of the
/// bond, so that a spiral stands at every distance from the rib equally often.
struct RibRatio {
  double mean = 0.0;
  double smallest = 0.0, largest = 0.0;  ///< of a single bed
  int sails = 0;
  int beds = 0;
};

/// Rings after which the bond repeats within a sail: for spirals, until each stands where its neighbour
/// stood.
int bond_period(const Bond& bond);

/// The ratio of the uppermost stack: a sail begins at azimuth 0. None without sails or common beds.
std::optional<RibRatio> rib_ratio(const ThrustInput& input, const Bond& bond);

}  // namespace cupola
