#include "postproc/report/worst_joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/model/ending.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/mechanics/joint_speeds.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/report/html.hpp"

namespace cupola {
namespace {

std::string named_block(const Evaluation& e, int b) {
  const std::string& name = e.assembly.blocks[static_cast<size_t>(b)].name;
  return name.empty() ? fmt::format("{}", b) : fmt::format("{} ({})", b, name);
}

/// "The bed joint between blocks 12 and 45", a link that shows it in the 3-D view, or its second block where
/// the view has no joints.
std::string joint_link(const Evaluation& e, size_t index) {
  const JointWrench& joint = e.last.joints.wrenches[index];
  const std::string target =
      at_rest(e) ? fmt::format("joint=\"{}\"", index) : fmt::format("block=\"{}\"", joint.block_b);
  return fmt::format("<a href=\"#view\" data-{}>The {} joint between blocks {} and {}</a>", target,
                     joint.kind == JointKind::other ? "" : to_string(joint.kind),
                     html_text(named_block(e, joint.block_a)), html_text(named_block(e, joint.block_b)));
}

std::string list_html(const std::string& heading, const std::string& items) {
  return items.empty() ? "" : fmt::format("<p><strong>{}</strong></p>\n<ul>\n{}</ul>\n", heading, items);
}

std::string at_rest_html(const Evaluation& e) {
  const WorstJoints worst = worst_joints(e.last.joints);
  std::string out;
  if (worst.sliding && e.last.joints.wrenches[*worst.sliding].friction_use > 0.0) {
    const JointWrench& j = e.last.joints.wrenches[*worst.sliding];
    out += fmt::format("<li>{} {}: it uses {:.3g} % of its friction under {}.</li>\n",
                       joint_link(e, *worst.sliding),
                       j.friction_use > kSlides ? "is at its friction limit" : "is the nearest to sliding",
                       100.0 * j.friction_use, html_text(normal_force_text(j.normal_force)));
  }
  if (worst.edge && e.last.joints.wrenches[*worst.edge].kern != 0.0) {  // NaN on a line
    const JointWrench& j = e.last.joints.wrenches[*worst.edge];
    const double distance = std::abs(j.edge_distance);
    const bool on_edge = distance <= 1e-3 * std::sqrt(j.patch.area),
               beyond = j.edge_distance < 0.0;  // pulled
    const char* part = std::isnan(j.strength_use) ? "unloaded" : "unloaded or pulls";
    out += fmt::format(
        "<li>{} is the nearest to opening as a hinge: its force of {} acts {}{}.</li>\n",
        joint_link(e, *worst.edge), html_text(force_text(j.wrench.force.norm())),
        on_edge ? "on the edge" : length_text(distance) + (beyond ? " beyond" : " from") + " the edge",
        j.kern > 1.0 ? fmt::format(", outside the kern, so that a part of the joint is {}", part) : "");
  }
  const bool ideal = std::ranges::all_of(e.last.joints.wrenches, [&](const JointWrench& j) {
    return j.negligible || (j.kern == 0.0 && !uses_friction(e, j));
  });
  if (worst.edge && ideal)
    out = "<li>No joint is near sliding or opening: every force is normal to its joint and central.</li>\n";
  return list_html("Worst joints" + of_extent(e), out);
}

std::string moving_html(const Evaluation& e) {
  constexpr double kSmall = 0.01;  // of the fastest block: not shown
  const std::optional<MovingJoints> moving = moving_joints(e);
  if (!moving) return "";
  const bool mechanism = is_mechanism(e.last.frame.role);
  std::string out;
  const auto add = [&](const MovingJoints::Joint& joint, const char* speed, const char* distance) {
    if (mechanism && joint.motion >= kSmall)
      out += fmt::format("<li>{} {} the fastest: at {:.3g} % of the speed of the fastest block.</li>\n",
                         joint_link(e, joint.index), speed, 100.0 * joint.motion);
    else if (!mechanism && joint.motion > 0.0)
      out += fmt::format("<li>{} {}: by {}.</li>\n", joint_link(e, joint.index), distance,
                         length_text(joint.motion));
  };
  add(moving->sliding, "slides", "has slid the farthest");
  add(moving->opening, "opens", "is open the widest of those that still touch");
  const bool gives_way = falls(e.summary);
  return list_html(gives_way ? "Where it gives way" : "Joints that moved most", out);
}

}  // namespace

bool uses_friction(const Evaluation& e, const JointWrench& joint) {
  const ContactTable& c = e.last.frame.contacts;
  if (joint.negligible) return false;
  for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
    const int row = e.last.joints.contacts[i];
    if (!e.last.joints.floor.hides(c.force[row] - c.force[row].dot(c.normal[row]) * c.normal[row]))
      return true;
  }
  return joint.friction_use > 0.0;
}

WorstJoints worst_joints(const JointWrenches& joints) {
  // Joints of small forces say little about the structure: a hinge needs force.
  constexpr double kLoaded = 0.1;  // of the largest joint force
  double largest = 0.0;
  for (const JointWrench& joint : joints.wrenches) largest = std::max(largest, joint.wrench.force.norm());
  WorstJoints worst;
  const auto use = [&](size_t j) { return std::min(joints.wrenches[j].friction_use, kSlides); };
  const auto kern = [&](size_t j) {  // a line is all edge
    const JointWrench& joint = joints.wrenches[j];
    return joint.patch.area == 0.0 && joint.normal_force > 0.0 ? std::numeric_limits<double>::infinity()
                                                               : joint.kern;
  };
  for (size_t j = 0; j < joints.wrenches.size(); ++j) {
    const JointWrench& joint = joints.wrenches[j];
    if (joint.negligible) continue;
    if (const auto& w = worst.sliding;
        std::isfinite(joint.friction_use) &&
        (!w || std::pair(use(j), joint.normal_force) > std::pair(use(*w), joints.wrenches[*w].normal_force)))
      worst.sliding = j;
    if (joint.wrench.force.norm() >= kLoaded * largest && !std::isnan(kern(j)) &&
        (!worst.edge || kern(j) > kern(*worst.edge)))
      worst.edge = j;
  }
  return worst;
}

std::optional<MovingJoints> moving_joints(const Evaluation& e) {
  const std::vector<JointWrench>& joints = e.last.joints.wrenches;
  const bool mechanism = is_mechanism(e.last.frame.role);
  if (at_rest(e) || e.summary.status == Status::unconverged || joints.empty()) return std::nullopt;
  if (!mechanism && e.last.frame.role != FrameRole::step) return std::nullopt;
  const bool still =
      std::ranges::all_of(e.last.frame.blocks.velocity, [](const Vec3& v) { return v.isZero(0.0); });
  if (mechanism && still) return std::nullopt;
  std::vector<JointSpeeds> speeds;
  if (mechanism) speeds = joint_speeds(e.assembly, e.last.frame, e.last.joints);
  MovingJoints out;
  for (size_t j = 0; j < joints.size(); ++j) {
    const double opening = mechanism ? speeds[j].opening : joints[j].opening,
                 sliding = mechanism ? speeds[j].sliding : joints[j].slip;
    if (sliding > out.sliding.motion) out.sliding = {j, sliding};
    if ((mechanism || joints[j].touches) && opening > out.opening.motion) out.opening = {j, opening};
  }
  return out;
}

std::string worst_joints_html(const Evaluation& e) {
  return at_rest(e) ? at_rest_html(e) : moving_html(e);
}

}  // namespace cupola
