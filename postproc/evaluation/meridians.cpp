#include "postproc/evaluation/meridians.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/evaluation/thrust.hpp"

namespace cupola {
namespace {

/// A meridian of the case, by default those over the x and y axes; of an arch its only one. Blocks without
/// courses, such as most imported ones, have none.
struct Drawn {
  std::string name;
  std::optional<double> azimuth_deg;
  int ring = 0;  // of its stack
};

/// The meridians of the stack that ends with a sheet. In a model of several stacks their names begin with
/// that of the sheet.
std::vector<Drawn> drawn_meridians(const Evaluation& e, const Sheet& sheet, bool alone) {
  using enum Sheet::ThrustLines;
  const auto name = [&](const std::string& own) { return alone ? own : sheet.name + " " + own; };
  if (sheet.thrust_lines == one)
    return {{alone ? std::string(kOnlyArch) : sheet.name, std::nullopt, sheet.first_ring}};
  if (sheet.thrust_lines != by_azimuth) return {};
  std::vector<Drawn> meridians;
  for (const Meridian& meridian : e.scene.postproc.meridians)
    meridians.push_back({name(meridian.name), meridian.azimuth_deg, sheet.first_ring});
  if (meridians.empty())  // every vault has its thrust lines
    meridians = {{name("x"), 0.0, sheet.first_ring}, {name("y"), 90.0, sheet.first_ring}};
  return meridians;
}

std::vector<Drawn> drawn_meridians(const Evaluation& e) {
  std::vector<Drawn> meridians;
  if (e.shell.num_rings() == 0) return meridians;
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  const bool alone =
      std::count_if(sheets.begin(), sheets.end(), [](const Sheet& s) { return !s.on_previous; }) == 1;
  for (size_t i = 0; i < sheets.size(); ++i)
    if (i + 1 == sheets.size() || !sheets[i + 1].on_previous)
      for (Drawn& drawn : drawn_meridians(e, sheets[i], alone)) meridians.push_back(std::move(drawn));
  return meridians;
}

/// The thrust lines of the wythes along a meridian, each with the name of its wythe after that of the
/// meridian.
std::vector<ThrustLine> wythe_lines(const Evaluation& e, const ThrustInput& input, const Drawn& meridian) {
  std::vector<ThrustLine> lines;
  for (int wythe = 0; wythe < e.shell.num_wythes; ++wythe) {
    if (e.shell.is_alone(wythe)) continue;  // the whole thickness
    const std::string name = fmt::format("{}_{}", meridian.name, in_file_names(e.assembly.members[wythe]));
    ThrustLine line = thrust_line(input, name, meridian.azimuth_deg, wythe, meridian.ring);
    if (!line.points.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

/// Tension of courses across a meridian, through their bond alone.
struct HoopTension {
  double sum = 0.0;     ///< N, of all courses of the stack
  std::string largest;  ///< the sheet that has most of it; "": not known
  bool net = false;     ///< less the compression of other courses
};

HoopTension hoop_tension(const Evaluation& e, const FrameEvaluation& frame, const Drawn& meridian) {
  HoopTension tension;
  std::map<std::string, double> by_sheet;
  for (const HoopRow& row :
       hoop_forces(e.assembly, frame.joints, *meridian.azimuth_deg, frame.frame.ties, meridian.ring)) {
    const double pull = std::max(-(row.head_force + row.bed_force), 0.0);
    tension.sum += pull;
    if (const Sheet* sheet = e.assembly.sheet_of(row.ring)) by_sheet[sheet->name] += pull;
  }
  double most = 0.0;
  for (const auto& [name, pull] : by_sheet)
    if (pull > most) most = pull, tension.largest = name;
  return tension;
}

/// Adds the thrust lines at one end of a range to `member` of each meridian. Returns the hoop tension across
/// the first one.
HoopTension add_end(const ResultsReader& results, const RangeEnd& end,
                    std::optional<ThrustLine> MeridianEvaluation::*member, Evaluation* e) {
  HoopTension tension;
  if (end.outcome != RangeOutcome::bounded || !end.frame) return tension;
  try {
    const FrameEvaluation frame = evaluate_frame(*e, results.read_frame(*end.frame));
    const ThrustInput input = thrust_input(*e, frame);
    const std::vector<Drawn> meridians = drawn_meridians(*e);
    for (size_t i = 0; i < meridians.size(); ++i)
      e->meridians[i].*member =
          thrust_line(input, meridians[i].name, meridians[i].azimuth_deg, std::nullopt, meridians[i].ring);
    if (meridians.front().azimuth_deg) tension = hoop_tension(*e, frame, meridians.front());
  } catch (const InputError& error) {
    leave_out(fmt::format("frame {}", *end.frame), error.what(), e);
  }
  return tension;
}

/// Radial forces in equilibrium with a hoop tension T add up to 2 pi T: the share of the width of the range of
/// the thrust that tension in the courses can make.
void warn_of_hoop_tension(const HoopTension& least, const HoopTension& greatest, const ForceRange& range,
                          Evaluation* e) {
  constexpr double kMuch = 0.25;
  const bool at_least = least.sum >= greatest.sum;
  const HoopTension& tension = at_least ? least : greatest;
  if (!range.min.value || !range.max.value || e->assembly.sheets.empty()) return;
  const double width = *range.max.value - *range.min.value;
  const double share = 2.0 * std::numbers::pi * tension.sum / width;
  if (!(width > 0.0) || share < kMuch) return;
  e->warnings.push_back(fmt::format(
      "the range of the thrust counts on hoop tension: at its {} end the courses{} carry {}{} across "
      "a meridian by the friction of their bond, which as radial forces is {:.0f} % of its width. "
      "Masonry cracked along meridians carries none: `bond: {{type: stack}}` gives its range",
      at_least ? "least" : "greatest",
      e->assembly.sheets.size() > 1 && !tension.largest.empty() ? ", most of all of " + tension.largest + ","
                                                                : "",
      tension.net ? "at least " : "", force_text(tension.sum), 100.0 * share));
}

}  // namespace

std::string in_file_names(std::string text) {
  for (char& c : text)
    if (const auto code = static_cast<unsigned char>(c); code < 0x80 && std::isalnum(code) == 0 && c != '-')
      c = '_';
  return text;
}

ThrustInput thrust_input(const Evaluation& e, const FrameEvaluation& frame) {
  std::vector<PointForce> loads = frame.loads;
  const TieTable& ties = frame.frame.ties;
  for (int i = 0; i < ties.size(); ++i) {
    const Vec3 on_b = tie_force_on_b(ties, i);
    const int a = ties.block_a[i], b = ties.block_b[i];
    loads.push_back({a, frame.poses.as_built(a, ties.point_a[i]), -on_b});
    loads.push_back({b, frame.poses.as_built(b, ties.point_b[i]), on_b});
  }
  std::ranges::stable_sort(loads, {}, &PointForce::block);
  return {&e.assembly,      &e.shell,      &frame.frame.contacts, &frame.joints,
          frame.from_below, frame.gravity, frame.poses,           std::move(loads)};
}

std::vector<MeridianEvaluation> evaluate_meridians(const Evaluation& e) {
  std::vector<MeridianEvaluation> meridians;
  const ThrustInput input = thrust_input(e, e.last);
  for (const Drawn& drawn : drawn_meridians(e)) {
    meridians.push_back(
        {.thrust = thrust_line(input, drawn.name, drawn.azimuth_deg, std::nullopt, drawn.ring),
         .wythes = wythe_lines(e, input, drawn),
         .hoop = {},
         .least_thrust = {},
         .greatest_thrust = {}});
    if (drawn.azimuth_deg)
      meridians.back().hoop =
          hoop_forces(e.assembly, e.last.joints, *drawn.azimuth_deg, e.last.frame.ties, drawn.ring);
  }
  return meridians;
}

void add_ends_of_thrust(const ResultsReader& results, Evaluation* e) {
  const std::vector<ForceRange>& ranges = e->summary.ranges;
  const auto thrust = std::find_if(ranges.begin(), ranges.end(), [](const ForceRange& range) {
    return range.quantity.starts_with("thrust");
  });
  if (thrust == ranges.end() || e->meridians.empty()) return;
  HoopTension least = add_end(results, thrust->min, &MeridianEvaluation::least_thrust, e);
  const HoopTension greatest = add_end(results, thrust->max, &MeridianEvaluation::greatest_thrust, e);
  if (!thrust->min.frame)  // its state was not kept
    if (const auto net = net_hoop_tension(*e, thrust->min.value.value_or(0.0))) least = {*net, "", true};
  warn_of_hoop_tension(least, greatest, *thrust, e);
}

}  // namespace cupola
