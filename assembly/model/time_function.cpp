#include "assembly/model/time_function.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

double at(const ConstantInTime&, double) {
  return 1.0;
}

double at(const RampInTime& ramp, double time) {
  const double share = std::clamp((time - ramp.start) / ramp.duration, 0.0, 1.0);
  return ramp.from + share * (ramp.to - ramp.from);
}

double at(const HarmonicInTime& wave, double time) {
  if (time < wave.start) return 0.0;
  return std::sin(2.0 * std::numbers::pi * wave.frequency * (time - wave.start) +
                  wave.phase_deg * std::numbers::pi / 180.0);
}

double at(const TableInTime& table, double time) {
  CUPOLA_ASSERT(table.times.size() == table.values.size());
  if (table.times.empty()) return 0.0;
  if (time <= table.times.front()) return table.values.front();
  if (time >= table.times.back()) return table.values.back();
  const auto after = std::upper_bound(table.times.begin(), table.times.end(), time);
  const auto i = after - table.times.begin();
  const double share = (time - table.times[i - 1]) / (table.times[i] - table.times[i - 1]);
  return table.values[i - 1] + share * (table.values[i] - table.values[i - 1]);
}

}  // namespace

double factor_at(const TimeFunction& function, double time) {
  return std::visit([time](const auto& kind) { return at(kind, time); }, function);
}

TableInTime integrate_twice(const TableInTime& acceleration) {
  TableInTime displacement = acceleration;
  double velocity = 0.0;
  displacement.values.assign(acceleration.times.size(), 0.0);
  for (size_t i = 1; i < acceleration.times.size(); ++i) {
    const double dt = acceleration.times[i] - acceleration.times[i - 1];
    const double a0 = acceleration.values[i - 1], a1 = acceleration.values[i];
    displacement.values[i] = displacement.values[i - 1] + velocity * dt + (2.0 * a0 + a1) * dt * dt / 6.0;
    velocity += 0.5 * (a0 + a1) * dt;
  }
  return displacement;
}

}  // namespace cupola
