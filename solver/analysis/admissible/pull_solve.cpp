#include "solver/analysis/admissible/pull_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assembly/base/error.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/exact_equilibrium.hpp"
#include "solver/conic/motion_proof.hpp"
#include "solver/conic/solve_conic.hpp"

namespace cupola {
namespace {

/// The state of a solve with alpha <= 0 balances the loads, within the limits of its joints. Equilibrium may
/// lack, over the largest load of a block, rounding or a small share of what every contact has to spare. A
/// compressive strength is not spared by alpha: its excess is rounding, over the largest force.
bool balances(const PullSolve& solve) {
  constexpr double kRounding = 1e-9, kShare = 1e-3;
  ConicSolution state;
  state.gamma = admissible_state(solve);
  state.v = solve.solution.v;
  const ConicBounds bounds = conic_bounds(solve.scene.problem, state);
  if (bounds.imbalance <= std::max(kRounding, -kShare * solve.pull) && bounds.cone_violation <= kRounding)
    return true;
  // Cones that begin far from the forces, at a pull of cohesion over a small friction, leave more rounding.
  return proves_equilibrium(solve.scene.problem.contacts, solve.scene.problem.load, state.gamma);
}

/// No state without a pull exists whose forces are up to a multiple of those found, if any were, or none at
/// all.
bool proves_pull(const PullSolve& solve) {
  const ConicProblem& rigid = solve.scene.problem;
  return (!solve.solution.gamma(Eigen::seq(0, Eigen::last, 3)).isZero(0.0) &&
          conic_bounds(solve.problem, solve.solution).lower > 0.0) ||
         proves_motion(rigid.contacts, rigid.load, solve.solution.v);
}

/// Without pull columns that change an equilibrium or a strength, as between parallel walls, alpha is as small
/// as one likes if any state balances the loads, and no alpha helps if none does.
bool is_without_effect(const ConicProblem& problem, double press) {
  constexpr double kRounding = 1e-12;  // of a pressure
  return problem.load_columns.lpNorm<Eigen::Infinity>() <= kRounding * press &&
         std::ranges::none_of(problem.contacts.strength,
                              [](const ContactStrength& s) { return std::isfinite(s.compression); });
}

}  // namespace

PullSolve solve_pull(double value, RigidScene scene, double estimate) {
  PullSolve solve;
  solve.value = value;
  solve.scene = std::move(scene);
  const ConicProblem& rigid = solve.scene.problem;
  VecX press = VecX::Zero(rigid.cost.size());
  press(Eigen::seq(0, Eigen::last, 3)).setConstant(solve.scene.model.block_weight);
  solve.problem = with_multiplier(rigid, -generalized_impulse(rigid.contacts, press), 1.0);
  if (rigid.has_strength()) {  // gamma - alpha a may be pulled, but not pushed harder
    const ContactStrength pressed{0.0, 0.0, solve.scene.model.block_weight};
    solve.problem.strength_columns.assign(1, std::vector(rigid.contacts.strength.size(), pressed));
  }
  const bool any_pull = is_without_effect(solve.problem, solve.scene.model.block_weight);
  solve.solution = any_pull ? solve_conic(rigid)
                            : solve_conic(solve.problem, {.target = 1e-10, .relative_target = estimate});
  if (any_pull) {
    solve.solution.multipliers = VecX::Zero(1);
    if (solve.solution.outcome == ConicOutcome::optimal) solve.solution.outcome = ConicOutcome::unbounded;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  solve.pull = solve.solution.primal;
  switch (solve.solution.outcome) {
    case ConicOutcome::unbounded:
      solve.pull = -infinity;
      solve.decided = true;
      break;
    case ConicOutcome::infeasible:  // not even contacts that can pull hold it
      solve.pull = infinity;
      solve.decided = true;
      break;
    case ConicOutcome::optimal:
    case ConicOutcome::stalled:
      const bool stands = solve.pull <= 0.0 && balances(solve);
      const bool moves = !stands && proves_pull(solve);
      if (moves && solve.pull <= 0.0) solve.pull = infinity;  // the solve has found none
      solve.decided = stands || moves;
      break;
  }
  return solve;
}

JointsDerivative::JointsDerivative(double low, ContactProblem at_low, double high, ContactProblem at_high)
    : low_(std::move(at_low)), high_(std::move(at_high)), step_(high - low) {
  CUPOLA_ASSERT(low_.num_contacts() == high_.num_contacts());
}

double JointsDerivative::slope(const PullSolve& at) const {
  const VecX s = relative_velocity(at.problem.contacts, at.solution.v);
  VecX forces = at.solution.gamma;
  forces(Eigen::seq(0, Eigen::last, 3)).array() -= at.pull * at.scene.model.block_weight;
  double change = at.solution.v.dot(generalized_impulse(high_, forces) - generalized_impulse(low_, forces));
  for (int i = 0; i < low_.num_contacts(); ++i)
    change -= s.segment<2>(3 * i + 1).norm() * at.solution.gamma[3 * i] * (high_.mu[i] - low_.mu[i]);
  return change / step_;
}

VecX admissible_state(const PullSolve& solve) {
  if (solve.solution.outcome != ConicOutcome::unbounded) {
    VecX gamma = solve.solution.gamma;
    gamma(Eigen::seq(0, Eigen::last, 3)).array() -=
        solve.solution.multipliers[0] * solve.scene.model.block_weight;
    return gamma;
  }
  return solve_conic(solve.scene.problem).gamma;
}

}  // namespace cupola
