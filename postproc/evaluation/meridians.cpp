#include "postproc/evaluation/meridians.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// The thrust lines of all meridians in one frame.
std::vector<ThrustLine> thrust_lines(const Evaluation& e, const FrameEvaluation& frame) {
  const ThrustInput input = thrust_input(e, frame);
  std::vector<ThrustLine> lines;
  using enum SurfaceTraits::Meridians;
  const SurfaceTraits::Meridians drawn = traits_of(e.scene.geometry.surface).meridians;
  if (drawn == one) lines.push_back(thrust_line(input, "arch", std::nullopt));
  if (drawn == by_azimuth)
    for (const Meridian& meridian : e.scene.postproc.meridians)
      lines.push_back(thrust_line(input, meridian.name, meridian.azimuth_deg));
  return lines;
}

/// Adds the thrust lines at one end of a range to `member` of each meridian.
void add_end(const ResultsReader& results, const RangeEnd& end,
             std::optional<ThrustLine> MeridianEvaluation::*member, Evaluation* e) {
  if (end.outcome != RangeOutcome::bounded || !end.frame) return;
  try {
    std::vector<ThrustLine> lines = thrust_lines(*e, evaluate_frame(*e, results.read_frame(*end.frame)));
    for (size_t i = 0; i < lines.size(); ++i) e->meridians[i].*member = std::move(lines[i]);
  } catch (const InputError& error) {
    leave_out(fmt::format("frame {}", *end.frame), error.what(), e);
  }
}

}  // namespace

ThrustInput thrust_input(const Evaluation& e, const FrameEvaluation& frame) {
  return {&e.assembly, &e.shell, &frame.frame.contacts, &frame.joints, frame.from_below, frame.gravity};
}

std::vector<MeridianEvaluation> evaluate_meridians(const Evaluation& e) {
  std::vector<MeridianEvaluation> meridians;
  const bool vault = traits_of(e.scene.geometry.surface).meridians == SurfaceTraits::Meridians::by_azimuth;
  for (ThrustLine& line : thrust_lines(e, e.last)) {
    const double azimuth = line.azimuth_deg;
    meridians.push_back({.thrust = std::move(line), .hoop = {}, .least_thrust = {}, .greatest_thrust = {}});
    if (vault) meridians.back().hoop = hoop_forces(e.assembly, e.last.joints, azimuth, e.last.frame.ties);
  }
  return meridians;
}

void add_ends_of_thrust(const ResultsReader& results, Evaluation* e) {
  const std::vector<ForceRange>& ranges = e->summary.ranges;
  const auto thrust = std::find_if(ranges.begin(), ranges.end(), [](const ForceRange& range) {
    return range.quantity.starts_with("thrust") && (range.min.frame || range.max.frame);
  });
  if (thrust == ranges.end() || e->meridians.empty()) return;
  add_end(results, thrust->min, &MeridianEvaluation::least_thrust, e);
  add_end(results, thrust->max, &MeridianEvaluation::greatest_thrust, e);
}

}  // namespace cupola
