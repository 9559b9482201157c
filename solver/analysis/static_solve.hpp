#pragma once

#include <functional>
#include <string>

#include "assembly/base/named_enum.hpp"
#include "solver/analysis/cyclic_symmetry.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/simulation.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

struct StaticOptions {
  double tolerance = 1e-9;  ///< largest equilibrium residual accepted, inertia share included; no unit
  /// Method, friction law and iteration limit of each contact solve. Tolerance and reference speed follow
  /// from `tolerance` and h and need not be set.
  ContactSolverOptions solve = {};
  /// The structure may be a mechanism: start with a short h, at which a mechanism shows after few iterations,
  /// and raise it stepwise. If false, start with the h that an equilibrium to `tolerance` needs.
  bool may_move = false;
  /// Keep raising h until the motion proves that no contact forces balance the loads (kinematic_bound.hpp).
  bool certify = false;
  const CyclicSymmetry* symmetry = nullptr;  ///< if set, only one sector of the model is solved
  double time_advance = 0.0;                 ///< time by which loads and supports advance, s
  std::function<void(const std::string&)> log = [](const std::string&) {};
};

/// Equilibrium residual that is small enough to decide whether a structure stands.
constexpr double kOutcomeTolerance = 1e-5;

/// How a static solve ended.
enum class StaticOutcome {
  equilibrium,  ///< residual <= tolerance
  moving,       ///< no equilibrium: the speed grows in proportion to h
  unconverged   ///< the contact problem was not solved
};
constexpr auto enum_names(StaticOutcome) {
  return std::array{"equilibrium", "moving", "unconverged"};
}

/// The solution at the last h, with its accuracy.
struct StaticSolution {
  StaticOutcome outcome = StaticOutcome::unconverged;
  std::string message;
  double h = 0.0;  ///< s
  StepProblem step;
  ContactSolution step_solution;
  SolveSummary solve;
  Residuals residuals;
  ForceCertificate certificate;
  ForcesUnique forces_unique;
  JointForces forces;
  Equilibrium balance;
  double speed_ratio = 0.0;  ///< max |v| / (g h)
  int iterations = 0;        ///< sum over all h
};

/// Finds the equilibrium as one contact problem with v = 0 at the start and a large step (paper 2.1). The
/// displacement is h v. The inertia term carries a share of the load that falls with h^2; h is raised until
/// the equilibrium residual, which includes this share, meets the tolerance. In a structure that stands,
/// |v| / (g h) falls with h^2. Where it stops falling there is no equilibrium, and v is the collapse
/// mechanism. If one large h does not converge within a few iterations, the solve is repeated from a short h
/// raised stepwise, and a motion found then is certified.
StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options);

/// The contact problem at the first h that solve_static() tries.
StepProblem first_static_problem(const Model& model, const State& start, const ContactSet& contacts,
                                 const ContactMemories& memories, const StaticOptions& options);

/// The state after the step, at rest, with the load of each joint in its memory.
LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options);

}  // namespace cupola
