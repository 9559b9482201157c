#pragma once

#include "solver/collision/contact_detector.hpp"
#include "solver/contact/newton.hpp"
#include "solver/contact/residuals.hpp"
#include "solver/dynamics/energy.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// What one step did: the solve, its independent residuals, and the balance at the start of the step.
struct StepReport {
  SolveSummary solve;
  Residuals residuals;
  std::vector<Vec3> forces;  ///< N, world, on block b, in the order of the contacts
  Equilibrium balance;       ///< of those forces; what is unbalanced accelerates
  double slid_work = 0.0;    ///< J, lost to friction in this step
};

/// A scene in motion: everything that is carried from step to step.
class Simulation {
 public:
  Simulation(Model model, const StepOptions& step, const DetectionOptions& detection, double solve_tolerance);

  /// One step of h: detect, build, solve, remember, integrate (paper eq. 8-15).
  StepReport advance();

  const Model& model() const { return model_; }
  const State& state() const { return state_; }
  State* mutable_state() { return &state_; }
  const ContactSet& contacts() const { return detector_.contacts(); }
  const ContactMemories& memories() const { return memories_; }
  Energy energy() const { return compute_energy(model_, state_, contacts(), memories_); }
  Vec3 linear_momentum() const;             ///< N s, of the free blocks
  std::vector<Vec3> displacements() const;  ///< m, of the centroids since the assembly

 private:
  Model model_;
  StepOptions step_;
  State state_;
  ContactDetector detector_;
  ContactMemories memories_;
  double solve_tolerance_;
  NewtonSolver solver_;
};

}  // namespace cupola
