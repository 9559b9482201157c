#include "postproc/report/answers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/evaluation/margin.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/range_text.hpp"
#include "postproc/mechanics/cracks.hpp"
#include "postproc/report/report.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

/// "hinges form at 4 joints, 12 joints slide"; "" without a mechanism.
std::string what_gives_way(const Evaluation& e) {
  if (!e.gives_way) return "";
  std::vector<std::string> parts;
  const auto add = [&parts](int count, const char* one, const char* many) {
    if (count > 0) parts.push_back(fmt::format("{} {}", counted(count, "joint"), count == 1 ? one : many));
  };
  if (const int hinging = e.gives_way->hinging; hinging > 0)
    parts.push_back("hinges form at " + counted(hinging, "joint"));
  add(e.gives_way->sliding, "slides", "slide");
  add(e.gives_way->opening, "opens", "open");
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// "0.4", "1 kPa": a value of the parameter of a limit. `unit`: of limit_unit().
std::string value_text(double value, std::string unit, int digits = 5) {
  if (unit == "Pa") {
    const bool kilo = std::abs(value) < 1e6;
    value *= kilo ? 1e-3 : 1e-6, unit = kilo ? "kPa" : "MPa";
  }
  return fmt::format("{:.{}g}{}", value, digits, unit.empty() ? "" : " " + unit);
}

/// What the case has, and how far that is from the critical value.
std::string distance_text(const Evaluation& e, const std::string& unit) {
  const CriticalValue& critical = *e.summary.critical;
  const std::optional<double> factor = factor_of_safety(e.scene, e.summary);
  if (!factor || critical.parameter == "load") return "";  // the critical load is the factor
  const std::string own = value_text(*value_of_case(e.scene, critical.parameter), unit);
  return fmt::format("the case has {}{}", own, distance_from_limit(*factor, critical));
}

}  // namespace

std::string distance_from_limit(double factor, const CriticalValue& critical) {
  return critical.stable < critical.moving ? fmt::format(" and bears {:.3g} times as much", factor)
                                           : fmt::format(", {:.3g} times what it needs", factor);
}

namespace {

KeyNumber critical_answer(const Evaluation& e) {
  const CriticalValue& critical = *e.summary.critical;
  const std::optional<double> margin = factor_of_safety(e.scene, e.summary);
  if (critical.parameter == "joint_extent" && margin)
    return {"Geometric safety factor", fmt::format("{:.4g}", *margin),
            fmt::format("Heyman's, of the safest state: forces exist that stay inside joints of {:.4g} times "
                        "their extent, and none inside smaller ones",
                        critical.stable)};
  std::string unit = limit_unit(critical.parameter);
  if (unit == "factor") unit = critical.parameter == "load" ? "times the load" : "times";
  std::vector<std::string> details;
  if (const std::string distance = distance_text(e, unit); !distance.empty()) details.push_back(distance);
  if (const std::string decides = what_gives_way(e); !decides.empty())
    details.push_back(
        fmt::format("{} it {}", critical.stable < critical.moving ? "beyond" : "below", decides));
  if (shows_bracket(critical) || critical.value == 0.0)
    details.push_back(fmt::format("stands at {}, moves at {}", value_text(critical.stable, unit, 5),
                                  value_text(critical.moving, unit, 5)));
  return {"Critical " + critical.parameter, value_text(critical.stable, unit),
          fmt::format("{}", fmt::join(details, "; "))};
}

/// How to compute the margins of this case.
std::string command_for_margins(const Evaluation& e) {
  const std::filesystem::path file(e.scene.file.empty() ? "CASE.yaml" : e.scene.file);
  return "cupola assess " + file.filename().string();
}

const ForceRange* range_of_thrust(const Evaluation& e) {
  const auto& ranges = e.summary.ranges;
  const auto found = std::find_if(ranges.begin(), ranges.end(),
                                  [](const ForceRange& range) { return range.quantity == "thrust"; });
  return found == ranges.end() ? nullptr : &*found;
}

std::string end_text(const RangeEnd& end, double value, const ForceRange& range) {
  const std::string text = std::isinf(value)   ? (value > 0 ? "∞" : "-∞")
                           : std::isnan(value) ? ""
                                               : range_number(value, range);
  return end.outcome == RangeOutcome::unconverged ? text + "?" : text;
}

/// The supports at which the thrust of the stack under a sheet counts: of an arch those at x > 0 in its own
/// frame, to which its first course belongs.
std::vector<Reaction> thrusting(const Evaluation& e, const Sheet& sheet) {
  const auto [first, end] = e.assembly.stack_of(sheet.first_ring);
  const Vec3 own_x(std::cos(sheet.turn), std::sin(sheet.turn), 0.0);
  std::vector<Reaction> at;
  for (const Reaction& r : e.reactions) {
    if (r.ring < first || r.ring >= end) continue;
    const double x = own_x.dot(e.assembly.blocks[r.block].centroid - sheet.origin);
    if (sheet.thrust_lines != Sheet::ThrustLines::one || x > 0.0) at.push_back(r);
  }
  return at;
}

double length_of(const std::vector<Reaction>& supports) {
  double length = 0.0;
  for (const Reaction& r : supports) length += r.length;
  return length;
}

/// The uppermost sheets of the stacks that push outwards, the last first.
std::vector<const Sheet*> pushing_sheets(const Evaluation& e) {
  std::vector<const Sheet*> pushing;
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  for (size_t i = sheets.size(); i-- > 0;)
    if ((i + 1 == sheets.size() || !sheets[i + 1].on_previous) && sheets[i].num_rings > 0 &&
        sheets[i].thrust_lines != Sheet::ThrustLines::none)
      pushing.push_back(&sheets[i]);
  return pushing;
}

/// "14.1 kN/m over 5 m of support"; "" where the length is unknown.
std::string per_metre(double thrust, double length) {
  if (!(length > 0.0)) return "";
  return fmt::format("{}/m over {} of support", force_text(thrust / length), length_text(length));
}

bool is_limit(const Evaluation& e) {
  return e.summary.analysis == AnalysisType::limit;
}

}  // namespace

VerdictWords words_of_status(Status status) {
  std::string words = words_of(status);
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  return {words, stands(status)};
}

VerdictWords verdict_words(const Evaluation& e) {
  if (const auto parts = parts_by_verdict(e.summary); at_rest(e) && parts.size() > 1)
    return {parts.contains("It falls") ? "It stands, except for what falls"
                                       : "It stands, except for what is undecided",
            false};
  if (!is_limit(e) || !e.summary.critical) return words_of_status(e.summary.status);
  const CriticalValue& critical = *e.summary.critical;
  const std::optional<double> own = value_of_case(e.scene, critical.parameter);
  if (!own) return words_of_status(e.summary.status);
  const bool upwards = critical.stable < critical.moving;
  const bool proven = e.summary.friction_law == FrictionLaw::associated;
  if (upwards ? *own <= critical.stable : *own >= critical.stable) return words_of_status(Status::stable);
  return words_of_status((upwards ? *own >= critical.moving : *own <= critical.moving) ? motion(proven)
                                                                                       : Status::bracketed);
}

KeyNumber margin_answer(const Evaluation& e) {
  if (e.summary.critical) return critical_answer(e);
  if (const auto& robust = e.summary.robustness)
    return {"Horizontal acceleration", fmt::format("{:.3g} g", robust->acceleration_g),
            fmt::format("borne in the weakest of {} directions, towards {:.4g} degrees", robust->directions,
                        robust->azimuth_deg)};
  if (is_limit(e) && at_rest(e))
    return {"Critical " + std::string(to_string(e.scene.analysis.limit.parameter)), "no limit",
            e.summary.message.substr(e.summary.message.rfind(": ") + 2)};
  if (!at_rest(e))
    return {"Margin", moves(e.summary.status) || e.summary.status == Status::collapsed ? "none" : "unknown",
            "no equilibrium was found; to compute what it lacks: " + command_for_margins(e)};
  return {"Margin", "not computed", "to compute it: " + command_for_margins(e)};
}

std::optional<KeyNumber> thrust_answer(const Evaluation& e) {
  if (const ForceRange* range = range_of_thrust(e)) {
    const std::string unit = range_unit(*range).after_blank();
    std::string detail = "certain for every history";
    if (range->chosen)
      detail += fmt::format("; the stiffness of the joints selects {}{}",
                            range_number(*range->chosen, *range), unit);
    const double length = e.assembly.sheets.empty() ? 0.0 : length_of(thrusting(e, e.assembly.sheets.back()));
    if (length > 0.0 && std::isfinite(least(*range)) && std::isfinite(greatest(*range)))
      detail += fmt::format("; {}/m to {}/m over {} of support", force_text(least(*range) / length),
                            force_text(greatest(*range) / length), length_text(length));
    if (least(*range) < 0.0) detail += "; inwards where negative";
    return KeyNumber{"Outward thrust",
                     fmt::format("{} to {}{}", end_text(range->min, least(*range), *range),
                                 end_text(range->max, greatest(*range), *range), unit),
                     detail};
  }
  const std::vector<const Sheet*> pushing = pushing_sheets(e);
  if (!at_rest(e) || pushing.empty() || e.rings.empty()) return std::nullopt;
  const auto thrust_of = [&e](const Sheet& sheet) {
    return e.rings.at(e.assembly.stack_of(sheet.first_ring).first).radial_thrust;
  };
  const Sheet& shell = *pushing.front();
  const bool alone = pushing.size() == 1;
  const std::vector<Reaction> supports = thrusting(e, shell);
  const double thrust = thrust_of(shell);
  if (thrust == 0.0 && is_stage(e.last.frame.role))
    return std::nullopt;  // the course laid last rests on others
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Reaction& r : supports) {
    lowest = std::min(lowest, r.outward);
    highest = std::max(highest, r.outward);
  }
  // Joints of a smaller extent do not have the length of the supports.
  const bool shrunk = e.summary.critical && e.summary.critical->parameter == "joint_extent";
  std::string detail = shrunk ? "" : per_metre(thrust, length_of(supports));
  if (is_arch(e) && !detail.empty()) detail = "on each side, " + detail;
  if (!alone) detail = fmt::format("of {}{}{}", shell.name, detail.empty() ? "" : ", ", detail);
  if (supports.size() > 1 && highest - lowest <= 1e-3 * std::abs(highest))
    detail += fmt::format("{}{} on each of {}", detail.empty() ? "" : "; ", force_text(highest),
                          counted(supports.size(), "support"));
  else if (supports.size() > 1)
    detail += fmt::format("{}{} to {}, depending on the support", detail.empty() ? "" : "; ",
                          lowest == 0.0 ? "0" : force_text(lowest), force_text(highest));
  if (alone && e.summary.weight_N > 0.0)
    detail += fmt::format("{}{:.3g} of the weight", detail.empty() ? "" : "; ", thrust / e.summary.weight_N);
  constexpr size_t kMost = 5;  // stacks
  for (size_t i = 1; i < std::min(pushing.size(), kMost); ++i) {
    const double other = thrust_of(*pushing[i]);
    const std::string along = per_metre(other, length_of(thrusting(e, *pushing[i])));
    detail +=
        fmt::format("; of {} {}{}{}", pushing[i]->name, force_text(other), along.empty() ? "" : ", ", along);
  }
  if (pushing.size() > kMost) detail += "; of the others in rings.csv";
  if (e.summary.critical && !is_stage(e.last.frame.role))
    detail += "; at the critical value, not that of the case";
  else if (!e.scene.joints.have_strength())
    detail += "; depends on the stiffness of the joints: the range over all states was not computed";
  return KeyNumber{"Outward thrust", force_text(thrust), detail};
}

std::optional<KeyNumber> crack_answer(const Evaluation& e) {
  const bool rigid = is_limit(e) || !e.summary.ranges.empty();
  if (!at_rest(e) || rigid) return std::nullopt;
  const std::vector<Crack> cracks = cracks_of(e.last.frame.contacts, e.last.joints);
  if (cracks.empty())
    return KeyNumber{
        "Widest crack", "none",
        fmt::format("no joint is open by more than {}", length_text(e.last.joints.floor.length))};
  double total = 0.0;
  for (const Crack& crack : cracks) total += crack.extent;
  const Crack& widest = *std::max_element(cracks.begin(), cracks.end(), [](const Crack& a, const Crack& b) {
    return a.widest_gap < b.widest_gap;
  });
  const JointWrench& joint = e.last.joints.wrenches[widest.joint];
  const auto through = std::ranges::count_if(e.cracks, &ShellCrack::through);
  return KeyNumber{
      "Widest crack", length_text(widest.widest_gap),
      fmt::format("in the {}joint between blocks {} and {}; {} open over {} in total, as {}, {} "
                  "through the shell",
                  joint.kind == JointKind::other ? "" : std::string(to_string(joint.kind)) + " ",
                  joint.block_a, joint.block_b,
                  counted(cracks.size(), "joint") + (cracks.size() == 1 ? " is" : " are"), length_text(total),
                  counted(e.cracks.size(), "crack"), through == 0 ? "none" : std::to_string(through))};
}

std::vector<std::string> terminal_lines(const Evaluation& e, const std::string& report) {
  const auto line = [](const char* name, const KeyNumber& n) {
    return fmt::format("  {:<9} {}; {}", name, n.value, n.detail);
  };
  std::vector<std::string> out{fmt::format("{}: {}", verdict_words(e).words, reason_for_verdict(e))};
  KeyNumber margin = margin_answer(e);
  if (margin.name != "Margin") margin.value = margin.name + " " + margin.value;
  out.push_back(line("margin", margin));
  out.push_back(fmt::format("  {:<9} {}", "weight", force_text(e.summary.weight_N)));
  if (const auto thrust = thrust_answer(e))
    out.push_back(line("thrust", *thrust));
  else
    out.push_back(fmt::format("  {:<9} none: {}", "thrust",
                              !at_rest(e)                   ? "no equilibrium was found"
                              : is_stage(e.last.frame.role) ? "the supports of the course laid last feel none"
                                                            : "the model has no axis from which to take it"));
  const std::vector<std::string> warnings = notices(e);
  out.push_back(warnings.empty() ? fmt::format("  {:<9} none", "warnings")
                                 : fmt::format("  {:<9} {}, in the report", "warnings", warnings.size()));
  out.push_back(fmt::format("  {:<9} {}", "report", report));
  return out;
}

}  // namespace cupola
