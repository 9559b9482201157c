#pragma once

#include "solver/analysis/admissible/rigid_scene.hpp"

namespace cupola {

/// The least pull alpha, over the mean block weight, that every contact would have to bear for the loads to
/// be balanced at one value of a parameter:
///
///     minimise alpha,  D (gamma - alpha a) + w = 0,  gamma in Y,  a = (1, 0, 0) times the mean block weight
///
/// In joints with a compressive strength F, gamma_n - alpha a is limited to F instead of gamma_n. An
/// admissible state exists where alpha <= 0.
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

/// `estimate`: stops at an error of the forces and of alpha of this share of alpha, for a step of Newton's
/// method. 0: solves to the end.
PullSolve solve_pull(double value, RigidScene scene, double estimate);

/// How the joints change with a parameter x, per unit of x. D and the friction must be linear functions of x.
class JointsDerivative {
 public:
  /// `low`, `high`: the joints at two values. Their contacts are the same.
  JointsDerivative(double low, ContactProblem at_low, double high, ContactProblem at_high);
  /// d alpha / dx = v . D' (gamma - alpha a) - sum_i |s_t,i| gamma_n,i mu_i' with the dual v, s: the
  /// derivative of the Lagrangian. Strengths that change too are left out.
  double slope(const PullSolve& at) const;

 private:
  ContactProblem low_, high_;
  double step_;
};

/// The admissible state of a solve with alpha <= 0.
VecX admissible_state(const PullSolve& solve);

}  // namespace cupola
