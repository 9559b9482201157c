#pragma once

#include <Eigen/SparseCore>

#include "solver/analysis/admissible/force_functional.hpp"
#include "solver/analysis/admissible/rigid_scene.hpp"
#include "solver/analysis/admissible/sector_problem.hpp"

namespace cupola {

/// The smallest value of an objective over all admissible states, or the largest.
struct RangeSolution {
  RangeEnd end;  ///< without frame
  VecX gamma;    ///< N: the state; of an unbounded end a self-stress whose largest force is one block weight
  VecX v;        ///< the mechanism that proves the bound
  int iterations = 0;
  bool of_sector = false;   ///< one sector was solved
  bool admissible = false;  ///< gamma is a state, to the accuracy of solve_conic()
};

/// `towards`: 1 for the smallest value, -1 for the largest. The scene must have an admissible state. With
/// `sector`, if the objective repeats around the axis, one sector is solved and its forces are repeated.
///
/// A ratio n(gamma) / d(gamma), d > 0, is made linear as Charnes and Cooper (1962), "Programming with linear
/// fractional functionals": with gamma' = t gamma and t >= 0,
///
///     minimise n(gamma')   subject to   D gamma' + t w = 0,   d(gamma') = 1
///
/// The strength of joints is multiplied by t as well. Where d may be negative, so is n / d = -n / -d.
RangeSolution range_end(const RigidScene& scene, const RangeObjective& objective, double towards,
                        const SectorProblem* sector = nullptr);

/// The end at the forces gamma with the mechanism v, of an objective that is no ratio. None if they do not
/// prove it to what a range promises.
std::optional<RangeSolution> range_end_of(const RigidScene& scene, const RangeObjective& objective,
                                          double towards, VecX gamma, VecX v);

/// The coefficients (3 nc) of an objective that no forces of dry joints make less than its constant, such as
/// a normal force: they lie in the dual cone Y*. Its least value is proven as soon as they vanish in a state
/// of any other end. Empty for other objectives.
using SparseX = Eigen::SparseVector<double>;
SparseX coefficients_in_dual_cone(const RigidScene& scene, const RangeObjective& objective);

/// |value - bound| of the worse end over the larger of the ends' sizes and `small`. 0 if no end is bounded.
double relative_gap(const ForceRange& range, double small);

}  // namespace cupola
