#include "solver/analysis/admissible/range_end.hpp"

#include <algorithm>
#include <cmath>

#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/solve_conic.hpp"

namespace cupola {
namespace {

/// An objective in the unknowns of a conic problem that has no other objective.
struct ConicObjective {
  const ConicProblem* problem = nullptr;
  VecX value;
  std::optional<VecX> over;
  bool of_sector = false;
};

/// In the forces of a sector where one is given and the objective repeats, else in those of the whole model.
ConicObjective objective_in(const RigidScene& scene, const RangeObjective& objective,
                            const SectorProblem* sector) {
  ConicObjective whole{&scene.problem, objective.value.coefficients(scene.contacts), {}};
  if (objective.over) whole.over = objective.over->coefficients(scene.contacts);
  if (sector == nullptr) return whole;
  const std::optional<VecX> value = sector->coefficients(whole.value, objective.mean_of_images);
  const std::optional<VecX> over = whole.over ? sector->coefficients(*whole.over, false) : std::nullopt;
  if (!value || over.has_value() != whole.over.has_value()) return whole;
  return {&sector->problem(), *value, over, true};
}

/// True for dry joints of which no forces make c . gamma negative.
bool is_in_dual_cone(const ConicProblem& problem, const VecX& c) {
  constexpr double kRounding = 1e-12;  // of the axes of a contact, relative
  if (problem.has_strength()) return false;
  for (int i = 0; i < problem.contacts.num_contacts(); ++i) {
    const Vec3 c_i = c.segment<3>(3 * i);
    if (c_i[0] < problem.contacts.mu[i] * c_i.tail<2>().norm() - kRounding * c_i.norm()) return false;
  }
  return true;
}

/// The conic problem whose least value is `towards` times the end.
ConicProblem problem_of(const ConicObjective& objective, double towards) {
  ConicProblem problem = *objective.problem;
  problem.cost = towards * objective.value;
  if (!objective.over) return problem;
  problem.load_columns = problem.load;
  problem.load.setZero();
  if (problem.has_strength()) {
    problem.strength_columns.assign(1, problem.contacts.strength);
    for (ContactStrength& strength : problem.contacts.strength)
      if (std::isfinite(strength.compression))
        strength = {0.0, 0.0, 0.0};
      else
        strength.tension = strength.cohesion = 0.0;
  }
  problem.multiplier_cost = VecX::Zero(1);
  problem.rows = *objective.over;
  problem.row_multipliers = MatX::Zero(1, 1);
  problem.row_values = VecX::Ones(1);
  return problem;
}

/// The same without loads: t = 0.
ConicProblem without_loads(ConicProblem problem) {
  problem.load_columns.resize(Eigen::NoChange, 0);
  problem.strength_columns.clear();
  problem.multiplier_cost.resize(0);
  problem.row_multipliers.resize(0, 1);
  return problem;
}

double largest_normal_force(const VecX& gamma) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < gamma.size(); i += 3) largest = std::max(largest, gamma[i]);
  return largest;
}

/// To what a range promises: relative to the value, or to `small`.
bool are_close(const ConicBounds& bounds, double small = 0.0) {
  constexpr double kProven = 1e-6;
  const double size = std::max({std::abs(bounds.upper), std::abs(bounds.lower), small});
  return bounds.imbalance <= kProven && std::abs(bounds.upper - bounds.lower) <= kProven * size;
}

RangeEnd end_of(const ConicBounds& bounds, bool bounded, double towards, double constant) {
  RangeEnd end;
  end.value = towards * bounds.upper + constant;
  end.bound = towards * std::min(bounds.lower, bounds.upper) + constant;
  if (!bounded) return end;
  end.outcome = RangeOutcome::bounded;
  // What its own bound does not tell from zero is zero.
  if (std::abs(*end.value) <= std::abs(*end.value - *end.bound)) end.value = 0.0;
  return end;
}

/// The signs of the denominator of a ratio in all admissible states. Joints that only press leave a normal
/// force none but 1; others have the signs of its own ends.
std::vector<double> signs_of(const ConicObjective& ratio, const RigidScene& scene, int* iterations) {
  constexpr double kNothing = 1e-9;  // of one block's weight; ConicOptions::tolerance
  if (is_in_dual_cone(*ratio.problem, *ratio.over)) return {1.0};
  std::vector<double> signs;
  for (const double sign : {1.0, -1.0}) {
    ConicProblem problem = *ratio.problem;
    problem.cost = -sign * *ratio.over;
    const ConicSolution solution = solve_conic(problem);
    *iterations += solution.iterations;
    if (solution.outcome == ConicOutcome::unbounded || -solution.primal > kNothing * scene.model.block_weight)
      signs.push_back(sign);
  }
  return signs;
}

/// The end over the states whose denominator, if there is one, is positive.
RangeSolution end_of(const RigidScene& scene, const ConicObjective& linear, double constant, double towards,
                     const SectorProblem* sector) {
  RangeSolution found;
  found.of_sector = linear.of_sector;
  ConicProblem problem = problem_of(linear, towards);
  ConicSolution solution = solve_conic(problem);
  found.iterations = solution.iterations;
  // The multiplier of the loads is free in the conic problem. Where it turns out negative, loads only hinder.
  if (linear.over && solution.multipliers[0] < 0.0) {
    problem = without_loads(problem);
    solution = solve_conic(problem);
    found.iterations += solution.iterations;
  }
  bool bounded = solution.outcome == ConicOutcome::optimal;
  found.admissible = bounded && !linear.over;
  if (bounded || solution.outcome == ConicOutcome::stalled) {
    const ConicBounds bounds = conic_bounds(problem, solution);
    bounded = bounded || are_close(bounds);  // rounding may have kept it from its tolerance
    found.end = end_of(bounds, bounded, towards, constant);
  }
  found.v = std::move(solution.v);
  found.gamma = linear.of_sector ? sector->whole_forces(solution.gamma) : std::move(solution.gamma);
  if (solution.outcome == ConicOutcome::infeasible && linear.over) {
    found.end.outcome = RangeOutcome::undefined;
    found.gamma.resize(0);  // it shows no state
  } else if (solution.outcome == ConicOutcome::unbounded) {
    found.end.outcome = RangeOutcome::unbounded;
    found.gamma *= scene.model.block_weight / largest_normal_force(found.gamma);
  } else if (linear.over && solution.multipliers.size() > 0 && solution.multipliers[0] > 0.0) {
    found.gamma /= solution.multipliers[0];
  }
  return found;
}

/// The end over two sets of states together: the one that lies farther out, or that is less certain.
RangeSolution join(RangeSolution one, RangeSolution other, double towards) {
  constexpr RangeOutcome kFarthest[] = {RangeOutcome::unbounded, RangeOutcome::unconverged,
                                        RangeOutcome::bounded, RangeOutcome::undefined};
  const auto rank = [&](const RangeSolution& x) { return std::ranges::find(kFarthest, x.end.outcome); };
  const int iterations = one.iterations + other.iterations;
  const bool alike = one.end.outcome == other.end.outcome;
  if (rank(other) < rank(one) ||
      (alike && one.end.value && other.end.value && towards * *other.end.value < towards * *one.end.value))
    std::swap(one, other);
  if (one.end.bound && other.end.bound)
    one.end.bound = towards * std::min(towards * *one.end.bound, towards * *other.end.bound);
  one.iterations = iterations;
  return one;
}

}  // namespace

RangeSolution range_end(const RigidScene& scene, const RangeObjective& objective, double towards,
                        const SectorProblem* sector) {
  const ConicObjective linear = objective_in(scene, objective, sector);
  const double constant = objective.value.constant;
  if (!linear.over) return end_of(scene, linear, constant, towards, sector);
  RangeSolution found;
  found.end.outcome = RangeOutcome::undefined;
  found.of_sector = linear.of_sector;
  for (const double sign : signs_of(linear, scene, &found.iterations)) {
    ConicObjective positive = linear;
    positive.value *= sign;
    *positive.over *= sign;
    found = join(std::move(found), end_of(scene, positive, constant, towards, sector), towards);
  }
  return found;
}

std::optional<RangeSolution> range_end_of(const RigidScene& scene, const RangeObjective& objective,
                                          double towards, VecX gamma, VecX v) {
  const ConicProblem problem = problem_of(objective_in(scene, objective, nullptr), towards);
  ConicSolution solution;
  solution.gamma = std::move(gamma);
  solution.v = std::move(v);
  const ConicBounds bounds = conic_bounds(problem, solution);
  if (!are_close(bounds, scene.model.block_weight)) return std::nullopt;
  RangeSolution found;
  found.end = end_of(bounds, true, towards, objective.value.constant);
  const double tolerance = ConicOptions().tolerance;
  found.admissible = bounds.imbalance <= tolerance && bounds.cone_violation <= tolerance;
  found.gamma = std::move(solution.gamma);
  found.v = std::move(solution.v);
  return found;
}

SparseX coefficients_in_dual_cone(const RigidScene& scene, const RangeObjective& objective) {
  if (objective.over) return {};
  const VecX c = objective.value.coefficients(scene.contacts);
  return is_in_dual_cone(scene.problem, c) ? SparseX(c.sparseView()) : SparseX();
}

double relative_gap(const ForceRange& range, double small) {
  double size = small, gap = 0.0;
  for (const RangeEnd* end : {&range.min, &range.max}) {
    if (!end->value || !end->bound) continue;
    size = std::max(size, std::abs(*end->value));
    gap = std::max(gap, std::abs(*end->value - *end->bound));
  }
  return gap > 0.0 ? gap / size : 0.0;
}

}  // namespace cupola
