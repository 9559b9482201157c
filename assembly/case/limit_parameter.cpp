#include "assembly/case/limit_parameter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/results.hpp"

namespace cupola {
namespace {

/// Makes a time function constant, with its value at time 0.
void freeze(TimeFunction* time) {
  if (std::holds_alternative<ConstantInTime>(*time)) return;
  const double factor = factor_at(*time, 0.0);
  *time = RampInTime{factor, factor, 0.0, 1.0};
}

/// Tension ends at cohesion over friction, so that more friction can bear less.
bool bear_tension(const Joints& joints) {
  const auto pulls = [](const JointLawChange& law) { return law.tension.value_or(0.0) > 0.0; };
  return joints.strength.tension > 0.0 ||
         std::ranges::any_of(joints.kinds(), [&](const auto& kind) { return pulls(*kind.second); }) ||
         std::ranges::any_of(joints.rings, [&](const RingJoints& group) { return pulls(group.law); });
}

bool is_within(double value, const LimitSearch& limit) {
  return limit.low <= value && value <= limit.high;
}

/// The value of the parameter at which the case is itself; none if its joints differ, or of a lantern in
/// newtons.
std::optional<double> value_of(const Case& scene) {
  using enum LimitSearch::Parameter;
  switch (scene.analysis.limit.parameter) {
    case friction: {
      const auto [least, greatest] = scene.joints.friction_range();
      return least == greatest ? std::optional(least) : std::nullopt;
    }
    case tilt:
    case acceleration:
      return 0.0;
    case load:
    case spread:  // a factor on the motion of the supports
    case thickness:
    case joint_extent:
      return 1.0;
    case lantern: {
      const TopLoad lantern = scene.loads.lantern.value_or(TopLoad{});
      return lantern.weight + lantern.mass > 0.0 ? std::nullopt : std::optional(lantern.weight_fraction);
    }
    case peak_stress: {
      const auto [least, greatest] = compressive_strengths(scene.joints);
      const bool varies = scene.joints.field && scene.joints.field->strength > 0.0;
      return least == greatest && std::isfinite(least) && !varies ? std::optional(least) : std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace

Case case_at(const Case& scene, double value) {
  Case at = scene;
  const LimitSearch& limit = scene.analysis.limit;
  const double g = scene.loads.gravity.norm();
  freeze(&at.joints.friction_time);
  freeze(&at.loads.dead_load_time);
  for (BlockForce& load : at.loads.forces) freeze(&load.time);
  for (FaceLoad& load : at.loads.faces) freeze(&load.time);
  switch (limit.parameter) {
    case LimitSearch::Parameter::friction: {
      RingJoints group = limit.joints.value_or(RingJoints{0, kLastRing, RingJoints::Sort::all, {}});
      group.law = {};
      group.law.friction = value;
      at.joints.rings.push_back(group);
      break;
    }
    case LimitSearch::Parameter::tilt: {
      const double angle = value * std::numbers::pi / 180.0;
      at.loads.gravity =
          std::cos(angle) * scene.loads.gravity + std::sin(angle) * g * direction_of_pull(scene);
      break;
    }
    case LimitSearch::Parameter::acceleration: {
      if (factor_at(scene.loads.dead_load_time, 0.0) == 0.0)
        throw InputError(
            "loads.dead_load_time = 0 at the time 0: a critical acceleration requires that the weight acts");
      at.loads.pull = value * g * direction_of_pull(scene);
      break;
    }
    case LimitSearch::Parameter::load:
      for (BlockForce& load : at.loads.forces) {
        load.force *= value;
        if (load.moment) *load.moment *= value;
      }
      for (FaceLoad& load : at.loads.faces) {
        load.traction *= value;
        load.pressure *= value;
      }
      break;
    case LimitSearch::Parameter::thickness:
    case LimitSearch::Parameter::joint_extent:
    case LimitSearch::Parameter::peak_stress:
      break;  // change the assembly, its contacts or what they carry, not the case
    case LimitSearch::Parameter::lantern:
      at.loads.lantern = TopLoad{value};
      break;
    case LimitSearch::Parameter::spread:  // 0 is a point, so that values above it keep their digits
      for (SupportMove& move : at.supports.moves)
        move.time = TableInTime{"", {-1e6, 0.0, 1e6}, {-1e6, 0.0, 1e6}};
      break;
  }
  return at;
}

Vec3 direction_of_pull(const Case& scene) {
  const Vec3 down = scene.loads.gravity.normalized();
  const Vec3& direction = scene.analysis.limit.direction;
  const Vec3 level = direction - direction.dot(down) * down;
  CUPOLA_ASSERT(level.norm() > 0.0);
  return level.normalized();
}

bool seeks_lantern(const Analysis& analysis) {
  return analysis.type == AnalysisType::limit && analysis.limit.parameter == LimitSearch::Parameter::lantern;
}

std::string varied_joints(const LimitSearch& limit) {
  if (limit.parameter != LimitSearch::Parameter::friction || !limit.joints) return "";
  const auto [from, to] = std::pair(limit.joints->from, limit.joints->to);
  const bool of_all_kinds = limit.joints->sort == RingJoints::Sort::all;
  if (of_all_kinds && from == 0 && to >= kLastRing) return "";
  const std::string kind = of_all_kinds ? "" : in_words(to_string(limit.joints->sort)) + " ";
  return from == to ? fmt::format(" of the {}joints of course {}", kind, from)
                    : fmt::format(" of the {}joints of courses {} to {}", kind, from, to);
}

std::string critical_quantity(const LimitSearch& limit) {
  return "critical " + in_words(to_string(limit.parameter)) + varied_joints(limit);
}

std::pair<double, double> compressive_strengths(const Joints& joints) {
  std::pair range{joints.strength.compression, joints.strength.compression};
  const auto include = [&range](const JointLawChange& law) {
    range.first = std::min(range.first, law.compressive_strength.value_or(range.first));
    range.second = std::max(range.second, law.compressive_strength.value_or(range.second));
  };
  for (const auto& kind : joints.kinds()) include(*kind.second);
  for (const RingJoints& group : joints.rings) include(group.law);
  return range;
}

std::optional<double> own_value(const Case& scene) {
  using enum LimitSearch::Parameter;
  const LimitSearch& limit = scene.analysis.limit;
  const std::optional<double> own = value_of(scene);
  switch (limit.parameter) {
    case friction:
      return varied_joints(limit).empty() && !bear_tension(scene.joints) ? own : std::nullopt;
    case joint_extent:
    case peak_stress:
      return own;
    case thickness:
      return std::nullopt;
    default:
      return own && is_within(*own, limit) ? own : std::nullopt;
  }
}

std::string case_outside_bracket(const Case& scene) {
  const LimitSearch& limit = scene.analysis.limit;
  const std::optional<double> own = value_of(scene);
  if (limit.parameter == LimitSearch::Parameter::peak_stress || !own || is_within(*own, limit)) return "";
  return fmt::format("the bracket leaves out the case itself, which has {}",
                     phrase(to_string(limit.parameter), *own));
}

}  // namespace cupola
