#include "postproc/evaluation/meridians.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// A meridian of the case, by default those over the x and y axes; of an arch its only one. Blocks without courses, such as most imported ones, have none.
struct Drawn {
  std::string name;
  std::optional<double> azimuth_deg;
};

std::vector<Drawn> drawn_meridians(const Evaluation& e) {
  using enum Sheet::ThrustLines;
  if (e.shell.num_rings() == 0 || e.assembly.sheets.empty()) return {};
  const Sheet::ThrustLines drawn = e.assembly.sheets.back().thrust_lines;
  std::vector<Drawn> meridians;
  if (drawn == one) meridians.push_back({"arch", std::nullopt});
  if (drawn != by_azimuth) return meridians;
  for (const Meridian& meridian : e.scene.postproc.meridians)
    meridians.push_back({meridian.name, meridian.azimuth_deg});
  if (meridians.empty()) meridians = {{"x", 0.0}, {"y", 90.0}};  // every vault has its thrust lines
  return meridians;
}

/// The thrust lines of the wythes along a meridian, each with the name of its wythe after that of the meridian.
std::vector<ThrustLine> wythe_lines(const Evaluation& e, const ThrustInput& input, const Drawn& meridian) {
  std::vector<ThrustLine> lines;
  for (int wythe = 0; wythe < e.shell.num_wythes; ++wythe) {
    if (e.shell.is_alone(wythe)) continue;  // the whole thickness
    const std::string name = fmt::format("{}_{}", meridian.name, in_file_names(e.assembly.members[wythe]));
    ThrustLine line = thrust_line(input, name, meridian.azimuth_deg, wythe);
    if (!line.points.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

/// Adds the thrust lines at one end of a range to `member` of each meridian.
void add_end(const ResultsReader& results, const RangeEnd& end,
             std::optional<ThrustLine> MeridianEvaluation::*member, Evaluation* e) {
  if (end.outcome != RangeOutcome::bounded || !end.frame) return;
  try {
    const FrameEvaluation frame = evaluate_frame(*e, results.read_frame(*end.frame));
    const ThrustInput input = thrust_input(*e, frame);
    const std::vector<Drawn> meridians = drawn_meridians(*e);
    for (size_t i = 0; i < meridians.size(); ++i)
      e->meridians[i].*member = thrust_line(input, meridians[i].name, meridians[i].azimuth_deg);
  } catch (const InputError& error) {
    leave_out(fmt::format("frame {}", *end.frame), error.what(), e);
  }
}

}  // namespace

std::string in_file_names(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return text;
}

ThrustInput thrust_input(const Evaluation& e, const FrameEvaluation& frame) {
  return {&e.assembly, &e.shell, &frame.frame.contacts, &frame.joints, frame.from_below, frame.gravity};
}

std::vector<MeridianEvaluation> evaluate_meridians(const Evaluation& e) {
  std::vector<MeridianEvaluation> meridians;
  const ThrustInput input = thrust_input(e, e.last);
  for (const Drawn& drawn : drawn_meridians(e)) {
    meridians.push_back({.thrust = thrust_line(input, drawn.name, drawn.azimuth_deg),
                         .wythes = wythe_lines(e, input, drawn),
                         .hoop = {},
                         .least_thrust = {},
                         .greatest_thrust = {}});
    if (drawn.azimuth_deg)
      meridians.back().hoop = hoop_forces(e.assembly, e.last.joints, *drawn.azimuth_deg, e.last.frame.ties);
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
