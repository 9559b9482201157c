#pragma once

#include <limits>
#include <optional>
#include <string>

#include "solver/collision/contact_detector.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/dynamics/energy.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/islands.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// What one step did: the solve, its independent residuals, and the balance at the start of the step.
struct StepReport {
  double h = 0.0;  ///< s
  SolveSummary solve;
  StepProblem problem;            ///< what was solved
  ContactSolution step_solution;  ///< and its answer
  Residuals residuals;
  JointForces forces;
  Equilibrium balance;     ///< of those forces; what is unbalanced accelerates
  double slid_work = 0.0;  ///< J, lost to friction in this step
  int rejected = 0;        ///< attempts at a larger h that the step control refused
  int asleep = 0;          ///< free blocks that were left out
};

/// Options of a simulation; simulation_options() builds them from a case.
struct SimulationOptions {
  StepOptions step;
  std::optional<AdaptiveStep> adaptive;  ///< none: every step lasts step.h
  std::optional<Sleep> sleep;            ///< none: every block is solved in every step
  /// The simulation starts from the static equilibrium under the loads at time 0. The analysis solves it and
  /// passes it to start_from().
  bool static_start = false;
  DetectionOptions detection;
  ContactSolverOptions solve;  ///< each step sets the reference speed
};

/// Result of a static solve from which a simulation starts: displaced blocks at rest, loaded joints.
struct LoadedState {
  State state;
  ContactMemories memories;
  double h = 0.0;  ///< s, step of the static solve: the impulses in `memories` over h are the joint forces
};

/// A scene in motion: everything that is carried from step to step.
class Simulation {
 public:
  Simulation(Model model, const SimulationOptions& options);

  /// One step: detect, build, solve, remember, integrate (paper eq. 8-15). h is that of the options, or, when
  /// adaptive, what the last step's error allows; never more than `h_max` (s). Problem and solution of the
  /// report are those of the blocks that are awake, its forces and balance those of all.
  StepReport advance(double h_max = std::numeric_limits<double>::infinity());

  /// Begins from an equilibrium instead of the unloaded assembly.
  void start_from(const LoadedState& loaded);

  /// Drops the factor that the solver keeps from step to step. A restored simulation has none, so whoever
  /// saves does this first: then both go on with the same bits.
  void forget_factor() { solver_ = ContactSolver(); }

  /// Everything that later steps depend on, as bytes, and a simulation of the same scene going on from it
  /// with the same bits. restore() throws std::runtime_error when the bytes do not fit.
  std::string save() const;
  void restore(const std::string& bytes);

  const SimulationOptions& options() const { return options_; }
  const Model& model() const { return model_; }
  const State& state() const { return state_; }
  State* mutable_state() {
    sleeping_.reset();
    return &state_;
  }
  const ContactSet& contacts() const { return detector_.contacts(); }
  const ContactMemories& memories() const { return memories_; }
  Energy energy() const { return compute_energy(model_, state_, contacts(), memories_); }
  Vec3 linear_momentum() const;             ///< N s, of the free blocks
  std::vector<Vec3> displacements() const;  ///< m, of the centroids since the assembly

 private:
  /// The step from the contacts on, of a scene or of its part that is awake.
  StepReport solve_and_move(const Model& model, const ContactSet& contacts, StepOptions step, State* state,
                            ContactMemories* memories);
  StepReport advance_awake(const ContactSet& contacts, const StepOptions& step);
  /// After contacts were found anew: memories and islands of the new ones.
  void follow_detection(const ContactSet& contacts);
  /// Farthest that a point of each block goes in a step of h at its present velocity, m.
  std::vector<double> travel(double h) const;

  Model model_;
  SimulationOptions options_;
  State state_;
  ContactDetector detector_;
  ContactMemories memories_;
  ContactSolver solver_;
  int detections_followed_ = 0;
  std::vector<double> radius_;  ///< m, of each free block
  std::vector<int> islands_;
  Sleepers sleepers_;
  std::optional<SleepingScene> sleeping_;  ///< none where nobody sleeps, or not yet made
  double next_h_;
};

}  // namespace cupola
