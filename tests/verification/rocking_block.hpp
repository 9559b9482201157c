#pragma once

namespace cupola::verification {

/// The first impact of a rocking block.
struct RockingImpact {
  double time = 0.0;   ///< s, the quarter period
  double speed = 0.0;  ///< rad/s, before the impact
  double ratio = 0.0;  ///< speed five steps after the impact over that before
};

/// Releases a block of half-width b and half-height H (m), tipped by `share` of its angle of overturning, on
/// a rough floor, with time steps h (s). Throws std::runtime_error if there is no impact within 2 s.
RockingImpact rock_until_impact(double b, double H, double share, double h);

}  // namespace cupola::verification
