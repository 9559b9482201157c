#pragma once

#include <limits>
#include <optional>
#include <string>

#include "solver/collision/contact_detector.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/dynamics/energy.hpp"
#include "solver/dynamics/energy_account.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/islands.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// Results of one step.
struct StepReport {
  double h = 0.0;  ///< s
  SolveSummary solve;
  StepProblem problem;            ///< of the blocks that are awake
  ContactSolution step_solution;  ///< of that problem
  Residuals residuals;            ///< computed independently of the solver
  JointForces forces;             ///< of all blocks
  /// law_violations() of all contacts; NaN where both blocks sleep
  std::vector<double> violations;
  Equilibrium balance;  ///< of all blocks under those forces, at the start of the step
  StepWork work;
  double time_error =
      0.0;        ///< m, estimated error of a displacement in this step, of the block where it is largest
  Energy energy;  ///< at the end of the step
  double elastic_impact = 0.0;  ///< s, elastic_impact()
  int num_asleep = 0;           ///< free blocks that slept
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

/// A scene in motion.
class Simulation {
 public:
  Simulation(Model model, const SimulationOptions& options);

  /// One step: detect contacts, build and solve the contact problem, update memories, integrate (paper eq.
  /// 8-15). The step is that of the options or, if adaptive, the one that the error of the last step allows;
  /// it never exceeds `h_max` (s).
  StepReport advance(double h_max = std::numeric_limits<double>::infinity());

  /// Starts from a static equilibrium instead of the unloaded assembly.
  void start_from(const LoadedState& loaded);

  /// Discards the matrix factor that the solver keeps from step to step. A restored simulation has none; call
  /// this before save() so that both continue with the same bits.
  void forget_factor() { solver_ = ContactSolver(); }

  /// Everything that later steps depend on, as bytes. A simulation of the same scene that restores them
  /// continues with the same bits. restore() throws std::runtime_error if the bytes do not fit the scene.
  std::string save() const;
  void restore(const std::string& bytes);

  const SimulationOptions& options() const { return options_; }
  const Model& model() const { return model_; }
  const State& state() const { return state_; }
  State* mutable_state() {
    reduced_.reset();
    energy_.reset();
    return &state_;
  }
  const ContactSet& contacts() const { return model_.heat.empty() ? detector_.contacts() : heated_; }
  const CollisionModel& shapes() const { return detector_.model(); }
  /// Where the blocks stood when the contacts were found.
  const std::vector<Pose>& contact_poses() const { return detector_.memory().now.poses; }
  const ContactMemories& memories() const { return memories_; }
  Energy energy() const { return compute_energy(model_, state_, contacts(), memories_); }
  Vec3 linear_momentum() const;  ///< N s, of the free blocks
  std::vector<Vec3> displacements() const { return cupola::displacements(*model_.assembly, state_); }

 private:
  /// All of the step after contact detection, for the whole scene or the part that is awake.
  StepReport solve_and_move(const Model& model, const ContactSet& contacts, StepOptions step, State* state,
                            ContactMemories* memories);
  /// Solves the contact problem of a step from `middle`, again until the damage of its joints is right.
  StepProblem solve_step(const Model& model, const ContactSet& contacts, const State& middle,
                         const StepOptions& step, const State& state, ContactMemories* memories,
                         ContactSolution* solution, StepReport* report);
  /// One step without its account of energy across detection and sleep.
  StepReport advance_detected(const ContactSet& contacts, const StepOptions& step);
  StepReport advance_awake(const ContactSet& contacts, const StepOptions& step);
  /// Sets heated_ for the contacts detected last, at the poses for which they were.
  void heat_contacts(const std::vector<Pose>& poses);
  /// Updates memories and islands after contacts were detected again, at `contact_poses`.
  void follow_detection(const ContactSet& contacts, const std::vector<Pose>& contact_poses);
  /// Largest distance that a point of each block moves in a step h under its present velocity and loads, but
  /// for what the margin of detection allows, or that of a support in the step, m (num_blocks).
  std::vector<double> travel(double h) const;

  Model model_;
  SimulationOptions options_;
  State state_;
  ContactDetector detector_;
  ContactSet heated_;  ///< those of detector_ with the gaps between heated faces; only of models with heat
  ContactMemories memories_;
  ContactSolver solver_;
  int detections_followed_ = 0;
  std::vector<double> radius_;  ///< m, largest distance of a vertex from the centroid (num_free)
  std::vector<int> islands_;
  SleepState sleep_state_;
  std::optional<ReducedScene> reduced_;  ///< set when first needed while blocks sleep
  double next_h_;
  double last_h_ = 0.0;           ///< s, of the last step; 0: none
  std::optional<Energy> energy_;  ///< at the end of the last step; unknown at first
};

}  // namespace cupola
