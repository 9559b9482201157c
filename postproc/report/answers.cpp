#include "postproc/report/answers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/with_capital.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/model/ending.hpp"
#include "postproc/evaluation/margin.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/report/gives_way.hpp"
#include "postproc/report/loads_text.hpp"
#include "postproc/report/report.hpp"

namespace cupola {
namespace {

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
  const bool grows = critical.parameter == "load" && critical.stable < critical.moving;
  if (!factor || grows) return "";  // the critical load is the factor
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
  std::vector<std::string> details;
  const std::string decides = how_it_gives_way(e);
  if (critical.parameter == "joint_extent" && margin) {
    details.push_back(
        fmt::format("Heyman's, of the safest state: forces exist that stay inside joints of {:.4g} times "
                    "their extent, and none inside smaller ones",
                    critical.stable));
    if (!decides.empty()) details.push_back("with these it " + decides);
    return {"Geometric safety factor", fmt::format("{:.4g}", *margin), details};
  }
  std::string unit = limit_unit(critical.parameter);
  if (unit == "factor") unit = critical.parameter == "load" ? "times the load" : "times";
  if (const std::string distance = distance_text(e, unit); !distance.empty()) details.push_back(distance);
  if (!decides.empty())
    details.push_back(
        fmt::format("{} it {}", critical.stable < critical.moving ? "beyond" : "below", decides));
  if (const auto& sought = e.summary.sought; sought && !sought->also.empty()) details.push_back(sought->also);
  if (const std::string direction = direction_of_limit(e.scene); !direction.empty())
    details.push_back(direction);
  if (shows_bracket(critical) || critical.value == 0.0)
    details.push_back(fmt::format("stands at {}, moves at {}", value_text(critical.stable, unit, 5),
                                  value_text(critical.moving, unit, 5)));
  std::string name = "Critical " + in_words(critical.parameter) + varied_joints(e.scene.analysis.limit);
  if (critical.parameter == "peak_stress") {
    name = "Least peak stress";
    details.emplace_back("no forces that balance the loads have less everywhere");
  }
  return {name, value_text(critical.stable, unit), details};
}

/// An argument as a shell takes it: in quotes where it has other characters than plain names.
std::string in_shell(const std::string& argument) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string("_-.+").find(c) != std::string::npos;
  };
  if (std::ranges::all_of(argument, plain)) return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

/// How to compute the margins of this case.
std::string command_for_margins(const Evaluation& e) {
  if (is_stage(e.last.frame.role)) {
    const std::vector<CuringMortar>& curing = e.scene.analysis.staged.curing;
    const bool cohesion = e.scene.joints.compliance.per == Compliance::Per::area &&
                          (curing.empty() || curing.front().law.cohesion);
    return fmt::format("`analysis.staged.least: {}`", cohesion ? "cohesion" : "friction");
  }
  const std::filesystem::path file(e.scene.file.empty() ? "CASE.yaml" : e.scene.file);
  const std::string name = in_shell(file.filename().string());
  const bool member = !e.scene.sweep.empty() || !e.scene.sample_file.file.empty() || e.scene.ensemble;
  // A case of many runs has no study of one; what extends it is one run.
  return member ? fmt::format("cupola assess a case that extends {}, with the values of this member", name)
                : "cupola assess " + name;
}

/// What a search ended with, if not with a value that counts.
KeyNumber sought_answer(const Sought& sought) {
  std::vector<std::string> details{sought.reason, sought.advice, sought.also};
  std::erase(details, "");
  return {with_capital(sought.quantity), sought.found.empty() ? "unknown" : sought.found, details};
}

/// True if the run searched for a value: of an equilibrium, or of a limit or stage whatever it does.
bool searched(const Evaluation& e) {
  return is_limit(e) || (e.scene.analysis.robustness > 0 && at_rest(e)) ||
         (is_stage(e.last.frame.role) && e.scene.analysis.staged.least != StagedConstruction::Least::none);
}

/// What the structure bears at the last equilibrium of a path that ends early.
KeyNumber end_of_path(const Evaluation& e) {
  std::vector<std::string> borne;
  for (const std::string& text : {loads_text(e), moved_text(e)})
    if (!text.empty()) borne.push_back(text);
  if (borne.empty()) borne.emplace_back();
  borne.front().insert(0, borne.front().empty() ? "at the last equilibrium" : "at the last equilibrium: ");
  return {"End of the path", fmt::format("{:.4g} s of {:.4g}", e.last.frame.time, e.scene.analysis.path.end),
          borne};
}

/// What the structure bears at most on a path by a length, where the loads fall again before its end.
KeyNumber largest_load(const Evaluation& e, double time) {
  FrameEvaluation most;
  set_loads(e, time, &most);
  const std::string loads = loads_text(e, most);
  const std::string when = fmt::format("at {:.4g} s of {:.4g}", time, e.scene.analysis.path.end);
  KeyNumber out{"Largest loads", loads.empty() ? when : loads, {}};
  if (!loads.empty()) out.details.push_back(when);
  out.details.push_back(fmt::format("the path ends at {:.4g} s", e.last.frame.time));
  out.details.emplace_back("of the equilibria found: between them the loads may be larger");
  return out;
}

/// The least acceleration that a search over directions found.
KeyNumber acceleration_answer(const Robustness& robust, int sought) {
  const int undecided = sought - robust.directions;
  KeyNumber out{"Horizontal acceleration", fmt::format("{:.3g} g", robust.acceleration_g), {}};
  if (!(robust.acceleration_g > 0.0)) {
    out.details.push_back(fmt::format("any push towards {:.4g} degrees makes it move", robust.azimuth_deg));
    return out;
  }
  out.details.push_back(fmt::format("borne in the weakest of {} directions, towards {:.4g} degrees",
                                    robust.directions, robust.azimuth_deg));
  if (undecided > 0)
    out.details.push_back(fmt::format("{} of {} {} undecided and may be weaker", undecided, sought,
                                      undecided == 1 ? "is" : "are"));
  return out;
}

/// "25 of them, wider than 2 % of the widest, form 12 cracks, 14 m long in all" and "none goes through the
/// shell": hairlines form no crack.
std::vector<std::string> texts_of_cracks(const std::vector<ShellCrack>& cracks, size_t open_joints) {
  if (cracks.empty()) return {};
  size_t joints = 0;
  double length = 0.0;
  for (const ShellCrack& crack : cracks) {
    joints += crack.joints.size();
    length += crack.length;
  }
  const std::string of_joints = joints == open_joints
                                    ? (joints == 1 ? "it forms" : "they form")
                                    : fmt::format("{} of them, wider than {:g} % of the widest, {}", joints,
                                                  100.0 * kHairline, joints == 1 ? "forms" : "form");
  std::vector<std::string> out{fmt::format(
      "{} {}, {}", of_joints, counted(cracks.size(), "crack"),
      length > 0.0 ? fmt::format("{} long{}", length_text(length), cracks.size() > 1 ? " in all" : "")
                   : "at single points")};
  if (std::ranges::all_of(cracks, [](const ShellCrack& c) { return c.course == CrackCourse::layers; }))
    return out;  // which have no faces to reach
  const auto through = std::ranges::count_if(cracks, &ShellCrack::through);
  out.push_back(through == 0 ? "none goes through the shell"
                             : fmt::format("{} {} through the shell", through, through == 1 ? "goes" : "go"));
  return out;
}

}  // namespace

VerdictWords words_of_run(const Summary& summary) {
  return {with_capital(words_of(summary)), stands(summary.status) && !summary.bears_loads_until_s};
}

VerdictWords verdict_words(const Evaluation& e) {
  if (const auto parts = parts_by_verdict(e.summary); at_rest(e) && parts.size() > 1)
    return {parts.contains("It falls") ? "It stands, except for what falls"
                                       : "It stands, except for what is undecided",
            false};
  if (!is_limit(e) || !e.summary.critical || e.summary.status == Status::unconverged)
    return words_of_run(e.summary);
  const CriticalValue& critical = *e.summary.critical;
  const std::optional<double> own = value_of_case(e.scene, critical.parameter);
  const bool unlimited = std::isinf(compressive_strengths(e.scene.joints).first);
  if (critical.parameter == "peak_stress" && unlimited) return words_of_run(e.summary);
  if (!own && !reached(e.summary.status)) return words_of_run(e.summary);
  if (!own) return {"Limit found", true};  // which says nothing of the case
  const bool upwards = critical.stable < critical.moving;
  const bool proven = e.summary.friction_law == FrictionLaw::associated;
  const bool stands = upwards ? *own <= critical.stable : *own >= critical.stable;
  const bool moves = upwards ? *own >= critical.moving : *own <= critical.moving;
  Summary of_case = e.summary;
  of_case.status = stands ? Status::stable : moves ? motion(proven) : Status::bracketed;
  return words_of_run(of_case);
}

KeyNumber margin_answer(const Evaluation& e) {
  if (e.summary.critical && e.summary.status != Status::unconverged) return critical_answer(e);
  if (const auto& robust = e.summary.robustness)
    return acceleration_answer(*robust, e.scene.analysis.robustness);
  if (e.scene.analysis.robustness > 0 && at_rest(e) && !e.summary.parts.empty())
    return {"Horizontal acceleration", "not computed", {"not all parts stand"}};
  if (e.summary.sought) return sought_answer(*e.summary.sought);
  if (searched(e)) return {"Margin", "unknown", {e.summary.message}};  // by a version that had no such record
  if (!at_rest(e)) {
    const bool sought = e.scene.analysis.robustness > 0, staged = is_stage(e.last.frame.role);
    KeyNumber out{sought ? "Horizontal acceleration" : "Margin",
                  falls(e.summary) ? "none" : "unknown",
                  {lack_of_equilibrium(e.summary, e.last.frame.role)}};
    if (!sought)
      out.details.push_back(
          (staged ? "to compute whether fresh mortar could hold it: " : "to compute what it lacks: ") +
          command_for_margins(e));
    return out;
  }
  if (e.last.frame.role == FrameRole::path) {
    if (const double latest = std::ranges::max(e.times); latest > e.times.back())
      return largest_load(e, latest);
    if (!stands(e.summary.status) || e.summary.bears_loads_until_s) return end_of_path(e);
  }
  return {"Margin", "not computed", {"to compute it: " + command_for_margins(e)}};
}

std::string after_last_stage(const Evaluation& e) {
  return is_stage(e.last.frame.role) ? "after the last stage: " : "";
}

KeyNumber pressure_number(double pressure, double strength_use) {
  return {
      kLargestPressure,
      pressure < 1e5 ? fmt::format("{:.3g} kPa", 1e-3 * pressure)
                     : fmt::format("{:.3g} MPa", 1e-6 * pressure),
      strength_use > 0.0
          ? std::vector{fmt::format("a joint uses at most {:.3g} % of its compressive or tensile strength",
                                    100.0 * strength_use)}
          : std::vector<std::string>{"no joint is in tension", "crushing was not checked"}};
}

std::optional<KeyNumber> crack_answer(const Evaluation& e) {
  if (!at_rest(e) || is_rigid(e)) return std::nullopt;
  if (supports_have_not_moved(e))
    return KeyNumber{kWidestCrack, "not computed", {"the supports move in time, and here they have not"}};
  const std::vector<Crack>& cracks = e.joint_cracks;
  if (cracks.empty())
    return KeyNumber{kWidestCrack,
                     "none",
                     {fmt::format("{}no joint is open by more than {}", after_last_stage(e),
                                  length_text(e.last.joints.floor.length))}};
  const Crack& widest = *std::max_element(cracks.begin(), cracks.end(), [](const Crack& a, const Crack& b) {
    return a.widest_gap < b.widest_gap;
  });
  const JointWrench& joint = e.last.joints.wrenches[widest.joint];
  std::vector<std::string> details{
      fmt::format("{}in the {}joint between blocks {} and {}", after_last_stage(e),
                  joint.kind == JointKind::other ? "" : std::string(to_string(joint.kind)) + " ",
                  joint.block_a, joint.block_b),
      fmt::format("{} {} open", counted(cracks.size(), "joint"), cracks.size() == 1 ? "is" : "are")};
  for (std::string& text : texts_of_cracks(e.cracks, cracks.size())) details.push_back(std::move(text));
  if (has_default_stiffness(e)) details.emplace_back("by the default stiffness of the joints");
  return KeyNumber{kWidestCrack, length_text(widest.widest_gap), details};
}

std::vector<std::string> terminal_lines(const Evaluation& e, const std::string& report) {
  const auto line = [](const char* name, const KeyNumber& n) {
    return fmt::format("  {:<9} {}; {}", name, n.value, n.detail());
  };
  std::vector<std::string> out{fmt::format("{}: {}", verdict_words(e).words, reason_for_verdict(e))};
  KeyNumber margin = margin_answer(e);
  if (margin.name != "Margin") margin.value = margin.name + " " + margin.value;
  out.push_back(line("margin", margin));
  const std::string loads = loads_text(e);
  out.push_back(
      fmt::format("  {:<9} {}{}", "weight", weight_text(e), loads.empty() ? "" : "; with " + loads));
  if (const auto thrust = thrust_answer(e))
    out.push_back(line("thrust", *thrust));
  else
    out.push_back(
        fmt::format("  {:<9} none: {}", "thrust",
                    !at_rest(e)                   ? lack_of_equilibrium(e.summary, e.last.frame.role)
                    : is_stage(e.last.frame.role) ? "the supports of the course laid last feel none"
                    : e.assembly.sheets.empty()
                        ? "no courses, no axis: geometry.import.axis is for rings; import arches singly"
                        : "a wall has no outside"));
  const std::vector<std::string> warnings = notices(e);
  out.push_back(fmt::format("  {:<9} {}", "warnings",
                            warnings.empty()       ? "none"
                            : warnings.size() == 1 ? warnings.front()
                                                   : fmt::format("{}, in the report; the first: {}",
                                                                 warnings.size(), warnings.front())));
  out.push_back(fmt::format("  {:<9} {}", "report", report));
  return out;
}

}  // namespace cupola
