#pragma once

#include <functional>
#include <optional>
#include <string>

#include "solver/analysis/cyclic_symmetry.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/simulation.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

struct StaticOptions {
  double tolerance = 1e-9;  ///< largest equilibrium residual, inertia share included
  ContactMethod method = ContactMethod::newton;
  FrictionLaw law = FrictionLaw::associated;
  /// Expects that the structure may move: begins with a short h, where a mechanism is told in few iterations,
  /// and raises it by degrees. Otherwise h is at once what an equilibrium of that tolerance needs.
  bool may_move = false;
  /// Goes on raising h until the motion proves that nothing balances the loads (kinematic_bound.hpp).
  bool certify = false;
  const CyclicSymmetry* symmetry = nullptr;          ///< of the model; then one sector is solved for all
  std::optional<int> max_iterations = std::nullopt;  ///< of the method per trial of h; none: its own limit
  double time_advance = 0.0;                         ///< s by which loads and supports go on in the step
  std::function<void(const std::string&)> log = [](const std::string&) {};
};

/// Equilibrium residual up to which a structure counts as standing where only the verdict matters.
constexpr double kVerdictTolerance = 1e-5;

enum class Verdict {
  equilibrium,  ///< residual <= tolerance
  moving,       ///< nothing holds it: the speed it picks up grows with h
  unconverged   ///< the contact problem was not solved
};

std::string to_string(Verdict verdict);

/// The answer at the last h and what it is worth.
struct StaticSolution {
  Verdict verdict = Verdict::unconverged;
  std::string message;
  double h = 0.0;  ///< s
  StepProblem step;
  ContactSolution step_solution;
  SolveSummary solve;
  Residuals residuals;
  JointForces forces;
  Equilibrium balance;
  double speed_ratio = 0.0;  ///< max |v| / (g h)
  int iterations = 0;        ///< of all trials
};

/// Equilibrium in one contact problem with v = 0 and a large step (paper 2.1). The inertia term carries a
/// share of the load that falls with h^2: h is raised until the equilibrium residual, share included, is as
/// small as asked. Displacement is h v. A structure that stands has |v| / (g h) falling with h^2; where it
/// ceases to fall there is no equilibrium, and v is the collapse mechanism. What one large h does not settle
/// in a few iterations is asked for again from a short h, by degrees, and its motion certified.
StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options);

/// The state after the step, at rest, with joints that remember their load.
LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options);

}  // namespace cupola
