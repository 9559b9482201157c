#include "assembly/model/time_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Index of the last of some increasing times that is not after `time`, which is not before the first.
size_t interval_of(const std::vector<double>& times, double time) {
  return static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin()) - 1;
}

double at(const TableInTime& table, double time) {
  CUPOLA_ASSERT(table.times.size() == table.values.size());
  if (table.times.empty()) return 0.0;
  if (time <= table.times.front()) return table.values.front();
  if (time >= table.times.back()) return table.values.back();
  const size_t i = interval_of(table.times, time);
  const double share = (time - table.times[i]) / (table.times[i + 1] - table.times[i]);
  return table.values[i] + share * (table.values[i + 1] - table.values[i]);
}

/// x = x_i + v_i s + (a_i / 2 + (a_(i+1) - a_i) s / (6 dt)) s^2 with s = t - t_i.
double at(const DisplacementInTime& motion, double time) {
  const TableInTime& table = motion.acceleration;
  if (table.times.empty()) return 0.0;
  if (time <= table.times.front()) return motion.displacement.front();
  if (time >= table.times.back())
    return motion.displacement.back() + (time - table.times.back()) * motion.velocity.back();
  const size_t i = interval_of(table.times, time);
  const double s = time - table.times[i];
  const double jerk = (table.values[i + 1] - table.values[i]) / (table.times[i + 1] - table.times[i]);
  return motion.displacement[i] + s * (motion.velocity[i] + s * (table.values[i] / 2.0 + s * jerk / 6.0));
}

constexpr double kNever = std::numeric_limits<double>::infinity();

double last(const ConstantInTime&) {
  return 0.0;
}

double last(const RampInTime& ramp) {
  return ramp.from == ramp.to ? 0.0 : ramp.start + ramp.duration;
}

double last(const HarmonicInTime&) {
  return kNever;
}

double last(const TableInTime& table) {
  for (size_t i = table.times.size(); i-- > 1;)
    if (table.values[i - 1] != table.values[i]) return table.times[i];
  return 0.0;
}

double last(const DisplacementInTime& motion) {
  const TableInTime& table = motion.acceleration;
  for (size_t i = table.times.size(); i-- > 0;)
    if (table.values[i] != 0.0) return table.times[std::min(i + 1, table.times.size() - 1)];
  return 0.0;
}

double corner(const ConstantInTime&, double) {
  return kNever;
}

double corner(const RampInTime& ramp, double after) {
  const double end = ramp.start + ramp.duration;
  return after < ramp.start ? ramp.start : after < end ? end : kNever;
}

double corner(const HarmonicInTime& wave, double after) {
  if (after < wave.start) return wave.start;
  const double eighth = 0.125 / wave.frequency;
  return wave.start + (std::floor((after - wave.start) / eighth) + 1.0) * eighth;
}

double corner(const TableInTime& table, double after) {
  const std::vector<double>&times = table.times, &values = table.values;
  const auto rate_before = [&](size_t i) {
    return i == 0 || i == times.size() ? 0.0 : (values[i] - values[i - 1]) / (times[i] - times[i - 1]);
  };
  const auto first = std::upper_bound(times.begin(), times.end(), after);
  for (auto i = static_cast<size_t>(first - times.begin()); i < times.size(); ++i)
    if (rate_before(i) != rate_before(i + 1)) return times[i];
  return kNever;
}

double corner(const DisplacementInTime& motion, double after) {
  return corner(motion.acceleration, after);
}

double pulse(const ConstantInTime&) {
  return kNever;
}

double pulse(const RampInTime&) {
  return kNever;
}

double pulse(const HarmonicInTime& wave) {
  return 0.5 / wave.frequency;
}

/// Where a table rises, or falls, all the way.
struct Flank {
  double start, end;  ///< s
  double rise;
};

/// Without those of noise.
std::vector<Flank> flanks(const TableInTime& table) {
  constexpr double kNoise = 0.05;  // of the range of values
  std::vector<Flank> all;
  for (size_t i = 1; i < table.values.size(); ++i) {
    const double rise = table.values[i] - table.values[i - 1];
    if (rise == 0.0) continue;
    if (all.empty() || all.back().rise * rise < 0.0) all.push_back({table.times[i - 1], 0.0, 0.0});
    all.back().end = table.times[i];
    all.back().rise += rise;
  }
  double highest = 0.0;
  for (const Flank& flank : all) highest = std::max(highest, std::abs(flank.rise));
  std::erase_if(all, [&](const Flank& flank) { return std::abs(flank.rise) < kNoise * highest; });
  return all;
}

/// From the middle of a flank to that of the next.
double pulse(const TableInTime& table) {
  const std::vector<Flank> all = flanks(table);
  double shortest = kNever;
  for (size_t i = 1; i < all.size(); ++i)
    if (all[i].rise * all[i - 1].rise < 0.0)
      shortest = std::min(shortest, 0.5 * (all[i].start + all[i].end - all[i - 1].start - all[i - 1].end));
  return shortest;
}

/// Of the velocity, since a step takes the integral of the acceleration whole.
double pulse(const DisplacementInTime& motion) {
  return pulse(TableInTime{.file = "", .times = motion.acceleration.times, .values = motion.velocity});
}

}  // namespace

double factor_at(const TimeFunction& function, double time) {
  return std::visit([time](const auto& kind) { return at(kind, time); }, function);
}

double last_change(const TimeFunction& function) {
  return std::visit([](const auto& kind) { return last(kind); }, function);
}

double seen_by(const TimeFunction& function) {
  const auto* wave = std::get_if<HarmonicInTime>(&function);
  return wave ? wave->start + 1.0 / wave->frequency : last_change(function);
}

double next_corner(const TimeFunction& function, double time) {
  constexpr double kRounding = 1e-9;  // s, of the time of a step that has ended at a corner
  return std::visit([time](const auto& kind) { return corner(kind, time + kRounding); }, function);
}

double shortest_pulse(const TimeFunction& function) {
  return std::visit([](const auto& kind) { return pulse(kind); }, function);
}

bool varies(const TimeFunction& function) {
  return last_change(function) > 0.0;
}

DisplacementInTime integrate_twice(const TableInTime& acceleration) {
  const std::vector<double>&times = acceleration.times, &a = acceleration.values;
  DisplacementInTime motion{acceleration, std::vector<double>(times.size(), 0.0),
                            std::vector<double>(times.size(), 0.0)};
  for (size_t i = 1; i < times.size(); ++i) {
    const double dt = times[i] - times[i - 1];
    motion.velocity[i] = motion.velocity[i - 1] + 0.5 * (a[i - 1] + a[i]) * dt;
    motion.displacement[i] =
        motion.displacement[i - 1] + motion.velocity[i - 1] * dt + (2.0 * a[i - 1] + a[i]) * dt * dt / 6.0;
  }
  return motion;
}

}  // namespace cupola
