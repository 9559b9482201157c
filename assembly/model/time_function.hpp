#pragma once

#include <string>
#include <variant>
#include <vector>

namespace cupola {

/// factor(t) = 1.
struct ConstantInTime {};

/// Goes linearly from one value to another, constant before and after.
struct RampInTime {
  double from = 0.0;
  double to = 1.0;
  double start = 0.0;     ///< s
  double duration = 1.0;  ///< s, > 0
};

/// sin(2 pi frequency t + phase).
struct HarmonicInTime {
  double frequency = 1.0;  ///< Hz, > 0
  double phase_deg = 0.0;  ///< deg; 90 makes a cosine
};

/// Linear between the points of a file (two columns: time in s, value), constant before and after.
struct TableInTime {
  std::string file;
  std::vector<double> times;   ///< s, strictly increasing; filled by load_tables()
  std::vector<double> values;  ///< as many
};

/// How a load, a support motion or a friction coefficient varies: the factor on its full value.
using TimeFunction = std::variant<ConstantInTime, RampInTime, HarmonicInTime, TableInTime>;

double factor_at(const TimeFunction& function, double time);

/// Displacement of a ground acceleration table (m/s2, linear between its points), from rest: integrated
/// exactly to velocity and displacement at the table's times. No baseline correction is made.
TableInTime integrate_twice(const TableInTime& acceleration);

}  // namespace cupola
