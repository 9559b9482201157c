#include "postproc/report/first_screen.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/range_text.hpp"
#include "postproc/report/html.hpp"
#include "postproc/report/report.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

/// From here on a joint slides: its friction use prints as 100 %.
constexpr double kSlides = 0.999;

std::string with_capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

KeyNumber critical_number(const CriticalValue& critical) {
  const std::string unit = limit_unit(critical.parameter);
  return {"Critical " + critical.parameter,
          fmt::format("{:.4g}{}", critical.value, unit.empty() ? "" : " " + unit),
          shows_bracket(critical) || critical.value == 0.0
              ? fmt::format("stands at {:.5g}, moves at {:.5g}", critical.stable, critical.moving)
              : fmt::format("known to a relative error of {:.1e}",
                            0.5 * std::abs(critical.stable - critical.moving) / std::abs(critical.value))};
}

/// "0.2202 to 32.62 MN": what the search proves, with ∞ where there is no limit and ? where it did not end.
KeyNumber range_number_of(const ForceRange& range) {
  const auto end = [&range](const RangeEnd& e, double value) {
    const std::string text = std::isinf(value)   ? (value > 0 ? "∞" : "-∞")
                             : std::isnan(value) ? ""
                                                 : range_number(value, range);
    return e.outcome == RangeOutcome::unconverged ? text + "?" : text;
  };
  const std::string chosen =
      range.chosen ? fmt::format("; chosen by the compliances: {}{}", range_number(*range.chosen, range),
                                 range_unit(range).after_blank())
                   : "";
  return {with_capital(range_name(range)),
          fmt::format("{} to {}{}", end(range.min, least(range)), end(range.max, greatest(range)),
                      range_unit(range).after_blank()),
          "certain for every history" + chosen};
}

void add_thrust_line(const Evaluation& e, std::vector<KeyNumber>* out) {
  const ThrustLine* worst = nullptr;
  for (const MeridianEvaluation& m : e.meridians)
    if (std::isfinite(m.thrust.least_face_distance) &&
        (!worst || m.thrust.least_face_distance < worst->least_face_distance))
      worst = &m.thrust;
  if (!worst || worst->undefined == static_cast<int>(worst->points.size())) return;
  const std::string safety = std::isfinite(worst->least_geometric_safety)
                                 ? fmt::format(", geometric safety {:.3g}", worst->least_geometric_safety)
                                 : "";
  out->push_back({"Thrust line to the nearer face", length_text(worst->least_face_distance),
                  fmt::format("least distance, meridian {}{}", worst->name, safety)});
}

void add_numbers_at_rest(const Evaluation& e, std::vector<KeyNumber>* out) {
  const PostSummary s = post_summary(e);
  if (e.summary.ranges.empty() && is_vault(e) && s.thrust_over_weight)
    out->push_back({"Outward thrust", force_text(e.rings.front().radial_thrust),
                    fmt::format("{:.3g} of the weight; one of the admissible states{}", *s.thrust_over_weight,
                                s.largest_strength_use ? "" : ", a range analysis gives the limits")});
  const auto& joints = e.last.joints.wrenches;
  if (s.largest_strength_use) {
    const auto outside =
        std::count_if(joints.begin(), joints.end(), [](const JointWrench& j) { return j.kern > 1.0; });
    out->push_back({kLargestPressure, fmt::format("{:.3g} MPa", 1e-6 * s.largest_pressure_Pa.value_or(0.0)),
                    fmt::format("a joint uses at most {:.3g} % of its compressive or tensile strength; the "
                                "forces of {} of {} lie outside the kern",
                                100.0 * *s.largest_strength_use, outside, counted(joints.size(), "joint"))});
  }
  add_thrust_line(e, out);
  const auto sliding = std::count_if(joints.begin(), joints.end(),
                                     [](const JointWrench& j) { return j.friction_use > kSlides; });
  out->push_back({kLargestFrictionUse, fmt::format("{:.3g} %", 100.0 * s.largest_friction_use.value_or(0.0)),
                  fmt::format("{} of {} slide", sliding, counted(joints.size(), "joint"))});
  double force = 0.0;
  for (const JointWrench& joint : joints) force = std::max(force, joint.wrench.force.norm());
  out->push_back({"Largest force of a joint", force_text(force),
                  fmt::format("weight of all blocks {}", force_text(e.summary.weight_N))});
  if (s.max_displacement_m)
    out->push_back(
        {"Largest displacement", length_text(*s.max_displacement_m), "from the compliance of the joints"});
}

void add_numbers_of_motion(const Evaluation& e, const std::vector<HistoryRow>& history,
                           std::vector<KeyNumber>* out) {
  const double threshold = e.scene.analysis.thresholds.displacement;
  double farthest = 0.0;
  for (const Vec3& d : e.last.frame.blocks.displacement) farthest = std::max(farthest, d.norm());
  if (!is_mechanism(e.summary, e.last.frame) && e.summary.analysis == AnalysisType::dynamic) {
    out->push_back(
        {"Largest displacement", length_text(farthest), fmt::format("after {:.4g} s", e.last.frame.time)});
    const auto first = std::find_if(history.begin(), history.end(), [threshold](const HistoryRow& row) {
      return row.max_displacement > threshold;
    });
    if (first != history.end())
      out->push_back({fmt::format("Moved more than {}", length_text(threshold)),
                      fmt::format("at {:.4g} s", first->time), "first block to do so"});
    if (!history.empty())
      out->push_back({"Fastest block", fmt::format("{:.3g} m/s", history.back().max_speed), "at the end"});
  }
  if (out->size() < 3)
    out->push_back({"Free blocks", fmt::format("{}", e.summary.free_blocks),
                    fmt::format("in {}", counted(e.summary.joints, "joint"))});
  if (out->size() < 3) out->push_back({"Weight", force_text(e.summary.weight_N), "of the free blocks"});
}

/// Whether the forces are those of the model, in words: "proven to 9 digits".
std::string how_sure(const Summary& s) {
  if (s.analysis == AnalysisType::limit && s.critical && s.critical->parameter != "peak_stress")
    return fmt::format(
        "The structure stands at one end of a bracket of relative width {:.1e} and moves at the other. {}",
        std::abs(s.critical->stable - s.critical->moving) / std::max(std::abs(s.critical->value), 1e-300),
        to_sentence(s.forces_unique));
  const auto ended = [](const ForceRange& r) {
    return r.min.outcome != RangeOutcome::unconverged && r.max.outcome != RangeOutcome::unconverged;
  };
  if (!s.ranges.empty() && std::all_of(s.ranges.begin(), s.ranges.end(), ended))
    return "The ranges hold for every admissible state. The forces shown are those of one of them.";
  if (!s.forces_unique.value) return to_sentence(s.forces_unique);
  const ForceCertificate& certificate = s.certified_force_error;
  if (!certificate.value)
    return fmt::format("No bound of the error of the forces is proven: {}.", certificate.bounds);
  const std::string article = certificate.bounds.starts_with("the ") ? "" : "the ";
  const int digits = static_cast<int>(std::floor(-std::log10(std::max(*certificate.value, 1e-16))));
  const std::string lead =
      digits > 0 ? fmt::format("The forces of this model are proven to {}", counted(digits, "digit"))
                 : "The forces of this model are known only roughly";
  return fmt::format("{}: {}{} is at most {:.1e}.", lead, article, certificate.bounds, *certificate.value);
}

std::string numbers_html(const std::vector<KeyNumber>& numbers) {
  std::string out = "<div class=\"key-numbers\">\n";
  for (const KeyNumber& n : numbers)
    out += fmt::format("<div><span>{}</span><strong>{}</strong><small>{}</small></div>\n",
                       markup_text(n.name), markup_text(n.value), markup_text(n.detail));
  return out + "</div>\n";
}

std::string named_block(const Evaluation& e, int b) {
  const std::string& name = e.assembly.blocks[static_cast<size_t>(b)].name;
  return name.empty() ? fmt::format("{}", b) : fmt::format("{} ({})", b, name);
}

/// "The bed joint between blocks 12 and 45 ... ", a link that shows it in the 3-D view.
std::string joint_link(const Evaluation& e, size_t index) {
  const JointWrench& joint = e.last.joints.wrenches[index];
  return fmt::format("<a href=\"#view\" data-joint=\"{}\">The {} joint between blocks {} and {}</a>", index,
                     joint.kind == JointKind::other ? "" : to_string(joint.kind),
                     markup_text(named_block(e, joint.block_a)), markup_text(named_block(e, joint.block_b)));
}

std::string worst_html(const Evaluation& e) {
  const WorstJoints worst = worst_joints(e.last.joints);
  std::string out;
  if (worst.sliding && e.last.joints.wrenches[*worst.sliding].friction_use > 0.0) {
    const JointWrench& j = e.last.joints.wrenches[*worst.sliding];
    out += fmt::format("<li>{} {}: it uses {:.3g} % of its friction under a normal force of {}.</li>\n",
                       joint_link(e, *worst.sliding),
                       j.friction_use > kSlides ? "slides" : "is the nearest to sliding",
                       100.0 * j.friction_use, markup_text(force_text(j.normal_force)));
  }
  if (worst.edge && e.last.joints.wrenches[*worst.edge].kern > 0.0) {
    const JointWrench& j = e.last.joints.wrenches[*worst.edge];
    const bool on_edge = j.edge_distance < 1e-3 * std::sqrt(j.patch.area);
    out += fmt::format("<li>{} is the nearest to opening as a hinge: its force of {} acts {}{}.</li>\n",
                       joint_link(e, *worst.edge), markup_text(force_text(j.wrench.force.norm())),
                       on_edge ? "on the edge" : length_text(j.edge_distance) + " from the edge",
                       j.kern > 1.0 ? ", outside the kern, so that a part of the joint is unloaded" : "");
  }
  const bool ideal = std::all_of(
      e.last.joints.wrenches.begin(), e.last.joints.wrenches.end(),
      [](const JointWrench& j) { return j.negligible || (j.kern == 0.0 && j.friction_use == 0.0); });
  if (worst.edge && ideal)
    out = "<li>No joint is near sliding or opening: every force is normal to its joint and central.</li>\n";
  return out.empty() ? "" : "<p><strong>Worst joints</strong></p>\n<ul>\n" + out + "</ul>\n";
}

}  // namespace

std::vector<KeyNumber> key_numbers(const Evaluation& e, const std::vector<HistoryRow>& history) {
  constexpr size_t kMost = 3;
  std::vector<KeyNumber> out;
  if (e.summary.critical) out.push_back(critical_number(*e.summary.critical));
  for (const ForceRange& range : e.summary.ranges)
    if (out.size() + 1 < kMost) out.push_back(range_number_of(range));
  if (at_rest(e.summary))
    add_numbers_at_rest(e, &out);
  else if (e.summary.status != Status::unconverged || !history.empty())
    add_numbers_of_motion(e, history, &out);
  if (out.size() > kMost) out.resize(kMost);
  return out;
}

WorstJoints worst_joints(const JointWrenches& joints) {
  // Joints of small forces say little about the structure: a hinge needs force.
  constexpr double kLoaded = 0.1;  // of the largest joint force
  double largest = 0.0;
  for (const JointWrench& joint : joints.wrenches) largest = std::max(largest, joint.wrench.force.norm());
  WorstJoints worst;
  const auto use = [&](size_t j) { return std::min(joints.wrenches[j].friction_use, kSlides); };
  const auto edge = [&](size_t j) {
    return joints.wrenches[j].edge_distance / std::sqrt(joints.wrenches[j].patch.area);
  };
  for (size_t j = 0; j < joints.wrenches.size(); ++j) {
    const JointWrench& joint = joints.wrenches[j];
    if (joint.negligible || joint.patch.area <= 0.0) continue;
    if (const auto& w = worst.sliding;
        std::isfinite(joint.friction_use) &&
        (!w || std::pair(use(j), joint.normal_force) > std::pair(use(*w), joints.wrenches[*w].normal_force)))
      worst.sliding = j;
    if (joint.wrench.force.norm() >= kLoaded * largest && std::isfinite(joint.edge_distance) &&
        (!worst.edge || edge(j) < edge(*worst.edge)))
      worst.edge = j;
  }
  return worst;
}

std::string first_screen(const Evaluation& e, const std::vector<HistoryRow>& history,
                         const std::string& viewer) {
  const Summary& s = e.summary;
  std::string out;
  for (const std::string& warning : notices(e))
    out += "<p class=\"warning\"><strong>Warning:</strong> " + markup_text(warning) + "</p>\n";
  out += fmt::format("<p class=\"verdict{}\"><strong>{}</strong> <small>{}</small></p>\n",
                     s.status == Status::stable ? "" : " bad", markup_text(verdict_text(s)),
                     markup_text(with_capital(s.message) + "."));
  if (at_rest(s)) out += "<p><strong>How sure is that?</strong> " + markup_text(how_sure(s)) + "</p>\n";
  out += numbers_html(key_numbers(e, history)) + viewer;
  return at_rest(s) ? out + worst_html(e) : out;
}

}  // namespace cupola
