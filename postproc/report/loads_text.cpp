#include "postproc/report/loads_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "assembly/case/limit_parameter.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/evaluation/thrust.hpp"
#include "postproc/mechanics/chain_forces.hpp"

namespace cupola {
namespace {

enum class LoadGroup { on_top, fill, on_faces, forces };
constexpr std::array kGroupNames{"load on top", "fill", "loads on faces", "forces"};

/// `time`: of a PointForce, see load_times().
LoadGroup group_of(const Loads& loads, int time) {
  if (time == PointForce::kDeadLoad || time == PointForce::kSteady) return LoadGroup::on_top;
  const size_t number = static_cast<size_t>(time);
  if (number < loads.forces.size()) return LoadGroup::forces;
  return loads.faces[number - loads.forces.size()].fill ? LoadGroup::fill : LoadGroup::on_faces;
}

constexpr double kRoundingOfSums = 1e-9;  // of the weight: forces that balance each other

/// N: the weight of the free blocks as it pulls at the time shown, inclined in a tilted model, with the
/// accelerations of a limit.
Vec3 pull_of_weight(const Evaluation& e, const FrameEvaluation& shown) {
  const double g = e.scene.loads.gravity.norm();
  return g > 0.0 ? Vec3(e.summary.weight_N / g * shown.gravity) : Vec3(Vec3::Zero());
}

/// "fill of 1.25 MN and forces of 328 kN, 4.22 MN in all": what acts downwards, and its sum with the weight.
std::string vertical_loads(const Evaluation& e, const FrameEvaluation& shown) {
  std::array<double, kGroupNames.size()> down{};
  for (const PointForce& load : shown.loads)
    down[static_cast<size_t>(group_of(e.acting, load.time))] -= load.force.dot(e.up);
  double total = -pull_of_weight(e, shown).dot(e.up);
  std::vector<std::string> parts;
  for (size_t i = 0; i < down.size(); ++i) {
    if (std::abs(down[i]) <= kRoundingOfSums * e.summary.weight_N) continue;
    total += down[i];
    parts.push_back(fmt::format("{} of {}", kGroupNames[i], force_text(down[i])));
  }
  if (parts.empty()) return "";
  const std::string last = parts.back();
  parts.pop_back();
  return fmt::format("{}{}{}, {} in all", fmt::join(parts, ", "), parts.empty() ? "" : " and ", last,
                     force_text(total));
}

/// "horizontal loads of 1 kN, 0.1 of the weight": the sum of the loads, and of the weight in a tilted model.
std::string horizontal_loads(const Evaluation& e, const FrameEvaluation& shown) {
  const double weight = e.summary.weight_N;
  Vec3 pull = pull_of_weight(e, shown);
  for (const PointForce& load : shown.loads) pull += load.force;
  const double aside = (pull - pull.dot(e.up) * e.up).norm();
  return aside > kRoundingOfSums * weight
             ? fmt::format("horizontal loads of {}, {:.3g} of the weight", force_text(aside), aside / weight)
             : "";
}

}  // namespace

std::string weight_text(const Evaluation& e) {
  const double acting = -pull_of_weight(e, e.last).dot(e.up), full = e.summary.weight_N;
  return force_text(acting) + (alike(acting, full) ? "" : " of " + force_text(full));
}

std::string loads_text(const Evaluation& e, const FrameEvaluation& shown) {
  const std::string vertical = vertical_loads(e, shown), horizontal = horizontal_loads(e, shown);
  return vertical + (vertical.empty() || horizontal.empty() ? "" : "; ") + horizontal;
}

std::string acting_ties(const Evaluation& e) {
  const int num_ties = num_ties_of(e.last.frame.ties, e.scene.supports.restraints);
  const std::vector<double>& force = e.last.frame.ties.force;
  const auto act = [&](int first, int end) {
    return std::any_of(force.begin() + first, force.begin() + end,
                       [&](double f) { return f > kRoundingOfSums * e.summary.weight_N; });
  };
  std::vector<const char*> acting;
  if (act(0, num_ties)) acting.push_back("ties");
  if (act(num_ties, static_cast<int>(force.size()))) acting.push_back("restraints");
  return fmt::format("{}", fmt::join(acting, " and "));
}

std::string carriers_text(const Evaluation& e) {
  const std::string ties = acting_ties(e);
  if (ties.empty()) return "joint forces";
  if (e.last.joints.wrenches.empty()) return ties;
  return fmt::format("joint forces{} {}", ties.find(" and ") == std::string::npos ? " and" : ",", ties);
}

std::string assumed_ties(const Evaluation& e) {
  const TieTable& ties = e.last.frame.ties;
  const int num_ties = num_ties_of(ties, e.scene.supports.restraints);
  const bool yield = std::any_of(ties.yield_force.begin(), ties.yield_force.end(),
                                 [](double force) { return std::isfinite(force); });
  std::vector<const char*> assumed;
  if (num_ties > 0) assumed.push_back(yield ? "the ties and their yield forces" : "the ties");
  if (ties.size() > num_ties) assumed.push_back("the restraints");
  return fmt::format("{}", fmt::join(assumed, ", "));
}

std::string direction_of_limit(const Case& scene) {
  const LimitSearch& limit = scene.analysis.limit;
  if (limit.parameter != LimitSearch::Parameter::tilt &&
      limit.parameter != LimitSearch::Parameter::acceleration)
    return "";
  const Vec3 d = direction_of_pull(scene).array() + 0.0;  // no -0
  std::string towards = fmt::format("({:.3g}, {:.3g}, {:.3g})", d.x(), d.y(), d.z());
  for (const int axis : {0, 1, 2})
    if (std::abs(d[axis]) == 1.0) towards = fmt::format("{}{}", d[axis] > 0.0 ? '+' : '-', "xyz"[axis]);
  return fmt::format("pulled towards {}{}; other directions are not computed", towards,
                     d.z() != 0.0 ? ", at right angles to gravity" : "");
}

std::string friction_text(const Joints& joints) {
  const auto [least, greatest] = joints.friction_range();
  if (least == greatest) return fmt::format("a coefficient of friction of {:g}", least);
  return fmt::format("coefficients of friction of {:g} to {:g}", least, greatest);
}

}  // namespace cupola
