#pragma once

#include "solver/analysis/admissible/rigid_scene.hpp"

namespace cupola {

/// The least pull alpha, over the mean block weight, that every contact would have to bear for the loads to be
/// balanced at one value of a parameter:
///
///     minimise alpha,   D (gamma - alpha a) + w = 0,   gamma in Y,   a = (1, 0, 0) times the mean block weight
///
/// In joints with a compressive strength F, gamma_n - alpha a is limited to F instead of gamma_n. An admissible state exists where alpha <= 0.
struct PullSolve {
  double value = 0.0;    ///< of the parameter
  double pull = 0.0;     ///< alpha; -infinity: as small as one likes, infinity: no pull holds it
  bool decided = false;  ///< the sign of alpha is proven
  RigidScene scene;
  ConicProblem problem;
  ConicSolution solution;
  bool admissible() const { return decided && pull <= 0.0; }
  bool moves() const { return decided && pull > 0.0; }
};

/// `estimate`: stops at an error of a hundredth of alpha, enough for a step of Newton's method.
PullSolve solve_pull(double value, RigidScene scene, bool estimate);

/// d alpha / dx of a parameter on which only the friction depends: -sum_i |s_t,i| gamma_n,i dmu_i/dx with the dual s.
double slope_in_friction(const PullSolve& at, const VecX& dmu_dx);

/// The admissible state of a solve with alpha <= 0.
VecX admissible_state(const PullSolve& solve);

}  // namespace cupola
