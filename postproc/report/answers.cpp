#include "postproc/report/answers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/evaluation/margin.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/range_text.hpp"
#include "postproc/mechanics/cracks.hpp"
#include "postproc/report/motion.hpp"
#include "postproc/report/report.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

/// "4 joints hinge, 12 slide"; "" without a mechanism.
std::string what_gives_way(const Evaluation& e) {
  if (!e.gives_way) return "";
  std::vector<std::string> parts;
  const auto add = [&parts](int count, const char* one, const char* many) {
    if (count > 0)
      parts.push_back(fmt::format("{} {}", parts.empty() ? counted(count, "joint") : std::to_string(count),
                                  count == 1 ? one : many));
  };
  add(e.gives_way->hinging, "hinges", "hinge");
  add(e.gives_way->sliding, "slides", "slide");
  add(e.gives_way->opening, "opens", "open");
  return fmt::format("{}", fmt::join(parts, ", "));
}

KeyNumber critical_answer(const Evaluation& e) {
  const CriticalValue& critical = *e.summary.critical;
  std::string unit = limit_unit(critical.parameter);
  double factor = 1.0;
  if (unit == "Pa") factor = critical.value < 1e6 ? 1e-3 : 1e-6, unit = critical.value < 1e6 ? "kPa" : "MPa";
  if (unit == "factor") unit = "times";
  const std::string value = fmt::format("{:.4g}{}", factor * critical.value, unit.empty() ? "" : " " + unit);
  std::string detail =
      shows_bracket(critical) || critical.value == 0.0
          ? fmt::format("stands at {:.5g}, moves at {:.5g}", factor * critical.stable,
                        factor * critical.moving)
          : fmt::format("known to a relative error of {:.1e}",
                        0.5 * std::abs(critical.stable - critical.moving) / std::abs(critical.value));
  if (const std::string decides = what_gives_way(e); !decides.empty())
    detail = fmt::format("beyond it {}; {}", decides, detail);
  const std::optional<double> margin = factor_of_safety(e.scene, e.summary);
  if (critical.parameter == "joint_extent" && margin)
    return {"Geometric safety factor", fmt::format("{:.4g}", *margin),
            fmt::format("Heyman's, of the safest state: forces exist that stay inside joints of {:.4g} times "
                        "their extent, and none inside smaller ones",
                        critical.stable)};
  if (margin && critical.parameter != "load")
    detail = fmt::format("factor {:.3g} from the {:.4g} of the case; {}", *margin, *value_of_case(e.scene),
                         detail);
  return {"Critical " + critical.parameter, value, detail};
}

/// How to compute the margins of this case.
std::string command_for_margins(const Evaluation& e) {
  const std::filesystem::path file(e.scene.file.empty() ? "CASE.yaml" : e.scene.file);
  return fmt::format("make -f Makefile.cases {}_assessment, or cupola assess {}", file.stem().string(),
                     file.filename().string());
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

/// The supports at which the thrust counts: of an arch those at x > 0, to which ring 0 belongs.
std::vector<Reaction> thrusting(const Evaluation& e) {
  std::vector<Reaction> at;
  for (const Reaction& r : e.reactions)
    if (!is_arch(e) || e.assembly.blocks[r.block].centroid.x() > 0.0) at.push_back(r);
  return at;
}

/// "14.1 kN/m over 5 m of support"; "" where the length is unknown.
std::string per_metre(double thrust, double length) {
  if (!(length > 0.0)) return "";
  return fmt::format("{}/m over {} of support", force_text(thrust / length), length_text(length));
}

/// The parts that a static analysis solved one by one, by what they do, proven or not.
std::map<std::string, std::vector<PartVerdict>> parts_by_verdict(const Evaluation& e) {
  std::map<std::string, std::vector<PartVerdict>> found;
  for (const PartVerdict& part : e.summary.parts) {
    found[stands(part.status) ? "It stands" : moves(part.status) ? "It falls" : "Undecided"].push_back(part);
  }
  return found;
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
  if (const auto parts = parts_by_verdict(e); at_rest(e) && parts.size() > 1)
    return {parts.contains("It falls") ? "It stands, except a part that falls"
                                       : "It stands, except an undecided part",
            false};
  if (!is_limit(e) || !e.summary.critical) return words_of_status(e.summary.status);
  const CriticalValue& critical = *e.summary.critical;
  const std::optional<double> own = value_of_case(e.scene);
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
    return {
        "Margin", "none",
        "without an equilibrium; a limit analysis finds the friction, load or thickness at which it stands"};
  return {"Margin", "not computed", command_for_margins(e) + ", computes all margins"};
}

std::optional<KeyNumber> thrust_answer(const Evaluation& e) {
  if (const ForceRange* range = range_of_thrust(e)) {
    const std::string unit = range_unit(*range).after_blank();
    std::string detail = "certain for every history";
    if (range->chosen)
      detail += fmt::format("; chosen by the compliances: {}{}", range_number(*range->chosen, *range), unit);
    double length = 0.0;
    for (const Reaction& r : thrusting(e)) length += r.length;
    if (length > 0.0 && std::isfinite(least(*range)) && std::isfinite(greatest(*range)))
      detail += fmt::format("; {} to {}/m over {} of support", force_text(least(*range) / length),
                            force_text(greatest(*range) / length), length_text(length));
    return KeyNumber{"Outward thrust",
                     fmt::format("{} to {}{}", end_text(range->min, least(*range), *range),
                                 end_text(range->max, greatest(*range), *range), unit),
                     detail};
  }
  if (!at_rest(e) || !(is_vault(e) || is_arch(e)) || e.rings.empty()) return std::nullopt;
  const Sheet& shell = e.assembly.sheets.back();
  const auto [first_ring, end] = e.assembly.stack_of(shell.first_ring);
  const bool alone = first_ring == 0;  // no supports of other stacks
  const std::vector<Reaction> supports = alone ? thrusting(e) : std::vector<Reaction>{};
  const double thrust = e.rings.at(first_ring).radial_thrust;
  double length = 0.0, lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Reaction& r : supports) {
    length += r.length;
    lowest = std::min(lowest, r.outward);
    highest = std::max(highest, r.outward);
  }
  // Joints of a smaller extent do not have the length of the supports.
  const bool shrunk = e.summary.critical && e.summary.critical->parameter == "joint_extent";
  std::string detail = shrunk ? "" : per_metre(thrust, length);
  if (!alone) detail = "of the stack of " + shell.name;
  if (supports.size() > 1 && highest - lowest <= 1e-3 * std::abs(highest))
    detail += fmt::format("{}{} on each of {}", detail.empty() ? "" : "; ", force_text(highest),
                          counted(supports.size(), "support"));
  else if (supports.size() > 1)
    detail += fmt::format("{}on a support {} to {}", detail.empty() ? "" : "; ", force_text(lowest),
                          force_text(highest));
  if (e.summary.weight_N > 0.0)
    detail += fmt::format("{}{:.3g} of the weight", detail.empty() ? "" : "; ", thrust / e.summary.weight_N);
  detail +=
      e.scene.joints.have_strength() ? "" : "; one of the admissible states, its range was not computed";
  return KeyNumber{"Outward thrust", force_text(thrust), detail};
}

std::optional<KeyNumber> crack_answer(const Evaluation& e) {
  const bool rigid = is_limit(e) || !e.summary.ranges.empty();
  if (!at_rest(e) || rigid) return std::nullopt;
  const std::vector<Crack> cracks = cracks_of(e.last.frame.contacts, e.last.joints);
  if (cracks.empty()) return KeyNumber{"Widest crack", "none", "every joint is closed"};
  double total = 0.0;
  for (const Crack& crack : cracks) total += crack.extent;
  const Crack& widest = *std::max_element(cracks.begin(), cracks.end(), [](const Crack& a, const Crack& b) {
    return a.widest_gap < b.widest_gap;
  });
  const JointWrench& joint = e.last.joints.wrenches[widest.joint];
  return KeyNumber{"Widest crack", length_text(widest.widest_gap),
                   fmt::format("in the {}joint between blocks {} and {}; {} open over {} in total",
                               joint.kind == JointKind::other ? "" : std::string(to_string(joint.kind)) + " ",
                               joint.block_a, joint.block_b,
                               counted(cracks.size(), "joint") + (cracks.size() == 1 ? " is" : " are"),
                               length_text(total))};
}

std::string reason_for_verdict(const Evaluation& e) {
  std::string text = at_rest(e) && !e.summary.parts.empty() ? "" : verdict_text(e.summary, e.last.frame.role);
  double farthest = 0.0;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b)
    if (e.assembly.blocks[b].fixed && at_rest(e))
      farthest = std::max(farthest, e.last.frame.blocks.displacement[b].norm());
  if (farthest > e.last.joints.floor.length)
    text += fmt::format(" Its supports have moved by up to {}.", length_text(farthest));
  if (const std::string parts = parts_sentence(e); !parts.empty()) text += (text.empty() ? "" : " ") + parts;
  return text;
}

std::string certain_sentence(const Evaluation& e) {
  const Summary& s = e.summary;
  const std::string given = fmt::format(
      "the shape of the blocks, their weight and loads, and a friction of {:g}", e.scene.joints.friction);
  if (s.status == Status::unconverged && !(is_limit(e) && s.critical) && s.ranges.empty())
    return "Nothing is certain: the requested accuracy was not reached.";
  if (!at_rest(e) && !s.critical) return how_sure_of_motion(e);
  if (is_limit(e) && s.critical)
    return fmt::format(
        "Certain: which side of the limit stands, whatever the stiffness of the joints and the history; "
        "under Coulomb's law it may fall earlier where joints slide. Assumed: {}.",
        given);
  if (!s.ranges.empty())
    return fmt::format("Certain: every state in which it can stand lies inside the ranges. Assumed: {}.",
                       given);
  std::string text = fmt::format(
      "{}. Assumed: {}, and the stiffness of the joints, which selects the forces shown among all that "
      "balance "
      "the loads.",
      proven(s.status) ? "Certain: forces within the joint laws balance the loads"
                       : "Not certain: forces balance the loads to the tolerance, exact ones were not found",
      given);
  if (!s.forces_unique.value) text += " " + to_sentence(s.forces_unique);
  return text;
}

namespace {

/// "1 block, number 7" or "12 blocks".
std::string blocks_of(const std::vector<PartVerdict>& parts) {
  int blocks = 0;
  for (const PartVerdict& part : parts) blocks += part.blocks;
  return counted(blocks, "block") +
         (blocks == 1 ? fmt::format(", number {}", parts.front().first_block) : "");
}

/// Of a run that solved its parts one by one: "Of 2 unconnected parts one falls (1 block, number 4), one stands (3 blocks)."
std::string sentence_of_verdicts(const Evaluation& e) {
  std::string text;
  for (const auto& [words, parts] : parts_by_verdict(e)) {
    const bool one = parts.size() == 1;
    const std::string verb = words == "It falls"    ? (one ? "falls" : "fall")
                             : words == "Undecided" ? (one ? "is undecided" : "are undecided")
                                                    : (one ? "stands" : "stand");
    text += fmt::format("{}{} {} ({})", text.empty() ? "" : ", ", one ? "one" : std::to_string(parts.size()),
                        verb, blocks_of(parts));
  }
  return fmt::format("Of {} unconnected parts {}.{}", e.summary.parts.size(), text,
                     at_rest(e) ? " The numbers belong to what stands." : "");
}

}  // namespace

std::string parts_sentence(const Evaluation& e) {
  if (!e.summary.parts.empty()) return sentence_of_verdicts(e);
  if (at_rest(e) || e.summary.status == Status::unconverged || e.parts.empty()) return "";
  constexpr double kMoves = 1e-3;  // of the fastest block
  const std::vector<Vec3>& v =
      is_mechanism(e.last.frame.role) ? e.last.frame.blocks.velocity : e.last.frame.blocks.displacement;
  double fastest = 0.0;
  for (const Vec3& x : v) fastest = std::max(fastest, x.norm());
  std::map<int, int> sizes, firsts;
  std::set<int> moving;
  for (int b = 0; b < static_cast<int>(e.parts.size()); ++b) {
    if (e.parts[b] < 0) continue;
    ++sizes[e.parts[b]];
    firsts.try_emplace(e.parts[b], b);
    if (v[b].norm() > kMoves * fastest) moving.insert(e.parts[b]);
  }
  if (sizes.size() < 2 || moving.empty() || moving.size() == sizes.size()) return "";
  int blocks = 0;
  for (const int part : moving) blocks += sizes[part];
  return fmt::format("Of {} unconnected parts {} ({}{}); the others, {}, are at rest.", sizes.size(),
                     moving.size() == 1 ? "one moves" : fmt::format("{} move", moving.size()),
                     counted(blocks, "block"),
                     blocks == 1 ? fmt::format(", number {}", firsts[*moving.begin()]) : "",
                     counted(e.summary.free_blocks - blocks, "block"));
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
                              at_rest(e) ? "a model without an axis" : "no equilibrium was found"));
  const std::vector<std::string> warnings = notices(e);
  out.push_back(warnings.empty() ? fmt::format("  {:<9} none", "warnings")
                                 : fmt::format("  {:<9} {}, in the report", "warnings", warnings.size()));
  out.push_back(fmt::format("  {:<9} {}", "report", report));
  return out;
}

}  // namespace cupola
