#include <algorithm>

#include "assembly/base/error.hpp"
#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/solve_conic.hpp"

namespace cupola {
namespace {

/// No stress limits edges and corners.
double area_of(const Contact& point, const RigidScene& rigid) {
  return bearing_area(point, rigid.contacts.patches[point.patch]);
}

/// gamma_n,i <= p A_i with the multiplier p; the joints' own compressive strength does not count.
ConicProblem stress_problem(const RigidScene& rigid) {
  ConicProblem problem = with_multiplier(rigid.problem, VecX::Zero(rigid.problem.load.size()), 1.0);
  auto& strength = problem.contacts.strength;
  strength.resize(static_cast<size_t>(problem.contacts.num_contacts()));
  std::vector<ContactStrength> per_stress(strength.size(), {0.0, 0.0, 0.0});
  for (size_t i = 0; i < rigid.contacts.points.size(); ++i) {
    const double area = area_of(rigid.contacts.points[i], rigid);
    if (area == 0.0) continue;
    strength[i].compression = 0.0;
    per_stress[i].compression = area;
  }
  problem.strength_columns.push_back(std::move(per_stress));
  return problem;
}

double area_of_joints(const RigidScene& rigid) {
  double area = 0.0;
  for (const Contact& point : rigid.contacts.points) area += area_of(point, rigid);
  return area;
}

/// Of all loads over all joints, Pa: what a stress of zero is small against.
double stress_of_loads(const RigidScene& rigid) {
  double loads = 0.0;
  for (Eigen::Index i = 0; i < rigid.problem.load.size(); i += 6)
    loads += rigid.problem.load.segment<3>(i).norm();
  return loads / area_of_joints(rigid);
}

}  // namespace

DirectLimit least_peak_stress(const Case& scene, RigidScene rigid, const ReportTrial& report) {
  if (scene.joints.compliance.per != Compliance::Per::area)
    throw InputError(
        "analysis.limit.parameter: peak_stress requires joints.compliance.per: area, with which contact "
        "points stand for areas");
  if (area_of_joints(rigid) == 0.0)
    throw InputError(
        "analysis.limit.parameter: peak_stress requires joints with an area: all blocks touch at edges or "
        "corners");
  const ConicProblem problem = stress_problem(rigid);
  const ConicSolution solution = solve_conic(problem);
  DirectLimit limit;
  limit.trials = 1;
  limit.iterations = solution.iterations;
  if (solution.outcome == ConicOutcome::infeasible) {
    limit.sought.reason = "no admissible state exists, whatever the stress";
    limit.mechanism = solution.v;
    limit.at_moving = std::move(rigid);
    return limit;
  }
  const ConicBounds bounds = conic_bounds(problem, solution);
  report({bounds.upper, true, {}, solution.iterations});
  limit.found = true;
  limit.admissible = std::max(0.0, bounds.upper);
  limit.moving = std::clamp(bounds.lower, 0.0, limit.admissible);  // no stress is less than none
  limit.span = stress_of_loads(rigid);
  limit.gamma = solution.gamma;
  limit.at_admissible = std::move(rigid);
  return limit;
}

}  // namespace cupola
