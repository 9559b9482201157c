#pragma once

#include <string>
#include <variant>
#include <vector>

namespace cupola {

/// factor(t) = 1.
struct ConstantInTime {};

/// Linear change from one value to another; constant before and after.
struct RampInTime {
  double from = 0.0;
  double to = 1.0;
  double start = 0.0;     ///< s
  double duration = 1.0;  ///< s, > 0
};

/// sin(2 pi frequency (t - start) + phase), and 0 before `start`.
struct HarmonicInTime {
  double frequency = 1.0;  ///< Hz, > 0
  double phase_deg = 0.0;  ///< deg; 90 gives a cosine
  double start = 0.0;      ///< s
};

/// Linear interpolation between points, constant before the first and after the last.
struct TableInTime {
  std::string file;            ///< two columns, time (s) and value; empty: the points are given in the case
  std::vector<double> times;   ///< s, strictly increasing
  std::vector<double> values;  ///< one per time
};

/// Displacement (m) under an acceleration that is linear between the points of a table and 0 beyond them:
/// cubic between them, and at constant velocity after the last, so that the velocity never jumps.
/// integrate_twice() fills it, or interpolate_smoothly() (smooth_motion.hpp).
struct DisplacementInTime {
  TableInTime acceleration;          ///< m/s2
  std::vector<double> velocity;      ///< m/s, one per time
  std::vector<double> displacement;  ///< m, one per time
};

/// Variation in time of a load, a support motion or a friction coefficient, as a factor on its full value.
using TimeFunction =
    std::variant<ConstantInTime, RampInTime, HarmonicInTime, TableInTime, DisplacementInTime>;

double factor_at(const TimeFunction& function, double time);

/// s, time from which on the factor stays the same, or that of an accelerogram has a constant velocity: 0 if
/// always, infinity for a wave.
double last_change(const TimeFunction& function);

/// s, time by which all that the function does has been seen: last_change(), or the first period of a wave.
double seen_by(const TimeFunction& function);

/// s, first time after `time` at which the function bends, or an eighth of a wave begins; infinity: none.
double next_corner(const TimeFunction& function, double time);

/// s, shortest time between a rise and a fall, or the reverse, that a longer step may leave out; infinity:
/// none. Of a DisplacementInTime that of its velocity.
double shortest_pulse(const TimeFunction& function);

/// True if the factor at some time after 0 differs from that at the time 0.
bool varies(const TimeFunction& function);

/// Motion that starts from rest at the first time of the table. Without baseline correction.
DisplacementInTime integrate_twice(const TableInTime& acceleration);

}  // namespace cupola
