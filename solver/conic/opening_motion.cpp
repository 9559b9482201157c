#include "solver/conic/opening_motion.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "solver/conic/normal_equations.hpp"
#include "solver/conic/scaled_problem.hpp"

namespace cupola {

VecX distance_inside(const ContactProblem& p, const VecX& v) {
  const VecX s = relative_velocity(p, v);
  VecX inside(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i)
    inside[i] = s[3 * i] - (p.mu[i] > 0.0 ? p.mu[i] * s.segment<2>(3 * i + 1).norm() : 0.0);
  return inside;
}

bool crushes(const ContactProblem& contacts, int i) {
  return !contacts.strength.empty() && std::isfinite(contacts.strength[i].compression);
}

VecX opening_motion(const ConicProblem& problem) {
  ScaledConicProblem s = scaled(problem);
  s.problem.load_columns.resize(Eigen::NoChange, 0);
  s.problem.row_multipliers.resize(0, 0);
  NormalEquations equations(s);
  std::vector<Mat3> weights(problem.contacts.num_contacts(), Mat3::Identity());
  VecX open = VecX::Zero(problem.cost.size());
  for (int i = 0; i < problem.contacts.num_contacts(); ++i)
    if (crushes(problem.contacts, i))
      weights[i].setZero();
    else
      open[3 * i] = 1.0;
  if (!equations.factorize(std::move(weights), MatX(s.problem.cost.size(), 0), MatX(0, 0))) return {};
  VecX v = s.white.to_v(equations.solve(generalized_impulse(s.white, open), VecX()).v);
  const VecX inside = distance_inside(problem.contacts, v);
  for (int i = 0; i < problem.contacts.num_contacts(); ++i)
    if (!(inside[i] > 0.0) && !crushes(problem.contacts, i)) return {};
  return v;
}

bool open_contacts(const ConicProblem& problem, ConicSolution* solution) {
  CUPOLA_ASSERT(problem.load_columns.cols() == 1 && problem.rows.cols() == 0 && problem.cost.isZero(0.0));
  constexpr double kMargin = 2.0;  // covers the rounding of the sum
  const VecX opening = opening_motion(problem);
  if (opening.size() == 0) return false;
  const VecX gained = distance_inside(problem.contacts, opening);
  const VecX inside = distance_inside(problem.contacts, solution->v);
  double share = 0.0;
  for (int i = 0; i < problem.contacts.num_contacts(); ++i)
    if (!crushes(problem.contacts, i)) share = std::max(share, -kMargin * inside[i] / gained[i]);
  const VecX v = solution->v + share * opening;
  const double power = problem.load_columns.col(0).dot(v);
  if (power * problem.multiplier_cost[0] >= 0.0) return false;
  solution->v = v * (-problem.multiplier_cost[0] / power);
  solution->dual = dual_value(problem, *solution);
  return true;
}

ConicBounds multiplier_bounds(const ConicProblem& problem, double enough, ConicSolution* solution) {
  ConicBounds bounds = conic_bounds(problem, *solution);
  if (ConicSolution opened = *solution;
      bounds.upper - bounds.lower > enough && open_contacts(problem, &opened)) {
    const ConicBounds improved = conic_bounds(problem, opened);
    if (improved.lower > bounds.lower) {
      bounds = improved;
      *solution = std::move(opened);
    }
  }
  bounds.lower = std::min(bounds.lower, bounds.upper);
  return bounds;
}

}  // namespace cupola
