#include "assembly/case/case_times.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/files/time_table.hpp"
#include "assembly/model/smooth_motion.hpp"

namespace cupola {
namespace {

const char* const kGround = "supports.base_motion";
constexpr double kSameTime = 1e-9;  // relative difference of equal times by rounding

/// What ends after `end` (s), the value of `key`.
std::vector<std::string> cut_off(const std::vector<KeyedTime>& times, const std::string& key, double end) {
  double last = 0.0;
  std::vector<std::string> cut;
  for (const KeyedTime& time : times) {
    const double until = seen_by(time.function);
    if (until <= (1.0 + kSameTime) * end) continue;
    cut.push_back(fmt::format("{} ({:g} s)", time.key, until));
    last = std::max(last, until);
  }
  if (cut.empty()) return {};
  return {fmt::format("{} = {:g} s ends before {}: the answer is that up to {:g} s; give {:g} s or more", key,
                      end, fmt::join(cut, ", "), end, last)};
}

/// s, when a motion jumps within a step (s).
std::optional<double> jump_in(const TimeFunction& function, double step) {
  const auto* wave = std::get_if<HarmonicInTime>(&function);
  if (wave && wave->start > 0.0 && std::abs(factor_at(function, wave->start)) > kSameTime) return wave->start;
  const auto* ramp = std::get_if<RampInTime>(&function);
  if (ramp && varies(function) && ramp->duration < (1.0 - kSameTime) * step) return ramp->start;
  return std::nullopt;
}

/// Supports that jump, before the end of a motion.
std::vector<std::string> jumps_of_supports(const Case& scene) {
  std::vector<std::string> out;
  const double step = scene.analysis.time_error ? 0.0 : scene.analysis.time_step;
  for (size_t i = 0; i < scene.supports.moves.size(); ++i)
    if (const auto time = jump_in(scene.supports.moves[i].time, step);
        time && *time < scene.analysis.duration)
      out.push_back(
          fmt::format("supports.moves[{}].time: jumps within a step at {:g} s, and throws what stands on the "
                      "support; let the motion begin at 0 and last several steps",
                      i, *time));
  return out;
}

}  // namespace

TimeFunction ground_time(const BaseMotion& motion) {
  const TableInTime table = read_time_table(motion.file);
  if (motion.quantity == BaseMotion::Quantity::acceleration) return integrate_twice(table);
  DisplacementInTime ground = interpolate_smoothly(table);
  const double start = factor_at(ground, 0.0);
  for (double& value : ground.displacement) value -= start;
  return ground;
}

std::vector<KeyedTime> times_of(const Case& scene) {
  std::vector<KeyedTime> times;
  const auto add = [&times](const char* key, const auto& list) {
    for (size_t i = 0; i < list.size(); ++i)
      times.push_back({fmt::format("{}[{}].time", key, i), list[i].time});
  };
  add("supports.moves", scene.supports.moves);
  add("loads.forces", scene.loads.forces);
  add("loads.faces", scene.loads.faces);
  add("loads.heat", scene.loads.heat);
  times.push_back({"loads.dead_load_time", scene.loads.dead_load_time});
  times.push_back({"joints.friction_time", scene.joints.friction_time});
  if (scene.supports.base_motion) times.push_back({kGround, ground_time(*scene.supports.base_motion)});
  return times;
}

double default_duration(const Case& scene) {
  double last = 0.0;
  for (const KeyedTime& time : times_of(scene)) last = std::max(last, seen_by(time.function));
  return last + Analysis().duration;
}

bool starts_static(const Case& scene) {
  if (scene.analysis.start != Analysis::Start::automatic)
    return scene.analysis.start == Analysis::Start::static_;
  return scene.supports.base_motion || !std::holds_alternative<ConstantInTime>(scene.joints.friction_time);
}

std::vector<std::string> unused_times(const Case& scene) {
  const Analysis& analysis = scene.analysis;
  std::vector<std::string> out;
  if (analysis.type == AnalysisType::dynamic || analysis.type == AnalysisType::path) return out;
  const bool spread =
      analysis.type == AnalysisType::limit && analysis.limit.parameter == LimitSearch::Parameter::spread;
  std::vector<std::string> values, moves;
  for (const KeyedTime& time : times_of(scene))
    if (varies(time.function) && time.key != kGround)
      (time.key.starts_with("supports.moves") ? moves : values)
          .push_back(fmt::format("{} = {:g}", time.key, factor_at(time.function, 0.0)));
  if (!moves.empty() && !spread)
    out.push_back(fmt::format(
        "{} at the time 0: analysis.type: {} leaves the rest of this movement out, and answers for the "
        "geometry as built; statics without `time` take all of it, type: path follows it, and for margins "
        "after it export the moved blocks (docs/cracked.md, step 8)",
        fmt::join(moves, ", "), to_string(analysis.type)));
  if (!values.empty())
    out.push_back(fmt::format(
        "{} at the time 0, which is all that analysis.type: {} uses; leave this out for the full value, "
        "or use type: path",
        fmt::join(values, ", "), to_string(analysis.type)));
  if (scene.supports.base_motion)
    out.push_back(fmt::format("{}: analysis.type: {} leaves it out; use type: dynamic", kGround,
                              to_string(analysis.type)));
  return out;
}

namespace {

/// A path of a given length ends there, whatever the time. Two steps in a pulse find it, at the least: one
/// may meet a wave whenever it is zero.
std::vector<std::string> missed_by_path(const Case& scene) {
  const LoadPath& path = scene.analysis.path;
  if (path.length) return {};
  const std::vector<KeyedTime> times = times_of(scene);
  std::vector<std::string> out = cut_off(times, "analysis.path.end", path.end);
  for (const KeyedTime& time : times)
    if (const double pulse = shortest_pulse(time.function);
        2.0 * path.end > (1.0 + kSameTime) * pulse * path.steps)
      out.push_back(
          fmt::format("analysis.path.steps = {}: steps of {:g} s exceed half a pulse of {}, {:.2g} s, which "
                      "they may leave out; give {:.0f} or more",
                      path.steps, path.end / path.steps, time.key, pulse,
                      std::ceil((1.0 - kSameTime) * 2.0 * path.end / pulse)));
  return out;
}

}  // namespace

std::vector<std::string> missed_changes(const Case& scene) {
  const Analysis& analysis = scene.analysis;
  if (analysis.type == AnalysisType::path) return missed_by_path(scene);
  if (analysis.type != AnalysisType::dynamic) return {};
  const std::vector<KeyedTime> times = times_of(scene);
  std::vector<std::string> out = cut_off(times, "analysis.duration", analysis.duration);
  const std::vector<std::string> jumps = jumps_of_supports(scene);
  out.insert(out.end(), jumps.begin(), jumps.end());
  if (analysis.time_error) return out;
  for (const KeyedTime& time : times)
    if (const double pulse = shortest_pulse(time.function); pulse < (1.0 - kSameTime) * analysis.time_step)
      out.push_back(fmt::format(
          "analysis.time_step = {:g} s exceeds a pulse of {}, {:.2g} s, which steps may leave out; "
          "give a shorter one, or analysis.time_error",
          analysis.time_step, time.key, pulse));
  return out;
}

}  // namespace cupola
