#include "assembly/model/results.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/with_capital.hpp"

namespace cupola {
namespace {

std::string label_of(const Frame& frame) {
  const double course = std::ceil(frame.time) + 0.0;  // not -0
  switch (frame.role) {
    case FrameRole::step:
    case FrameRole::path:
      return fmt::format("{:.3f} s", frame.time);
    case FrameRole::stage:
    case FrameRole::failed_stage:
      return frame.time == course
                 ? fmt::format("course {:g} laid", course)
                 : fmt::format("course {:g}, {:.0f} % laid", course, 100.0 * (1.0 - course + frame.time));
    case FrameRole::range_end:
    case FrameRole::self_stress:
      return with_capital(frame.owner);
    case FrameRole::equilibrium:
    case FrameRole::mechanism:
    case FrameRole::unconverged:
      break;
  }
  return to_string(frame.role);
}

}  // namespace

void set_role(FrameRole role, const std::string& owner, Frame* frame) {
  frame->role = role;
  frame->owner = owner;
  frame->label = label_of(*frame);
}

std::vector<Joint> joints_of(const ContactTable& contacts) {
  const int num_joints =
      contacts.joint.empty() ? 0 : 1 + *std::max_element(contacts.joint.begin(), contacts.joint.end());
  std::vector<Joint> joints(static_cast<size_t>(num_joints));
  for (int i = 0; i < contacts.size(); ++i) {
    CUPOLA_ASSERT(contacts.joint[i] >= 0 && contacts.block_a[i] < contacts.block_b[i]);
    joints[contacts.joint[i]] = {contacts.block_a[i], contacts.block_b[i], contacts.kind[i],
                                 contacts.ring[i]};
  }
  return joints;
}

void add_clause(const std::string& clause, std::string* text) {
  if (!clause.empty()) *text += (text->empty() ? "" : "; ") + clause;
}

std::string clauses(const Sought& sought) {
  std::string text = sought.reason;
  add_clause(sought.advice, &text);
  add_clause(sought.also, &text);
  return text;
}

std::string limit_unit(const std::string& parameter) {
  if (parameter == "tilt") return "degrees";
  if (parameter == "acceleration") return "g";
  if (parameter == "lantern") return "times the weight";
  if (parameter == "peak_stress" || parameter.ends_with("cohesion")) return "Pa";
  return parameter.ends_with("friction") ? "" : "factor";  // load, thickness, spread, joint_extent
}

std::string in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string critical_text(const CriticalValue& critical) {
  const std::string unit = limit_unit(critical.parameter);
  if (unit == "factor")
    return fmt::format("critical {} factor: {:.6g}", in_words(critical.parameter), critical.value);
  return fmt::format("critical {}: {:.6g}{}{}", in_words(critical.parameter), critical.value,
                     unit.empty() ? "" : " ", unit);
}

std::string phrase(const std::string& parameter, double value) {
  const std::string unit = limit_unit(parameter);
  const std::string name = parameter == "peak_stress" ? "compressive strength" : in_words(parameter);
  if (unit == "factor") return fmt::format("a {} factor of {:.5g}", name, value);
  return fmt::format("a{} {} of {:.5g}{}{}", name.starts_with('a') ? "n" : "", name, value,
                     unit.empty() ? "" : " ", unit);
}

}  // namespace cupola
