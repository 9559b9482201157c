#pragma once

#include <limits>
#include <optional>
#include <string>

#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// A speed ratio smaller than that of any mechanism whose load exceeds the critical one by a millionth.
constexpr double kAtRest = 1e-6;

/// Contraction of the residual from which blocks may be moving.
constexpr double kNoProgress = 0.5;

/// Part of the tolerance for the contact solve; inertia takes the rest.
constexpr double kSolveShare = 0.1;

/// Mean block weight over the largest load on a block. The equilibrium residual is relative to the former,
/// the residual of a contact solve to the latter, which is far larger where small blocks carry large loads.
double weight_over_load(const Model& model, double acceleration);

/// The proximal-point iteration of one scene (static_solve.hpp): what coming to rest (coming_to_rest.hpp) and
/// following a path (following_path.hpp) have in common. They differ in the step, in its accuracy, and in
/// what they call a motion.
class ProximalPoint {
 public:
  virtual ~ProximalPoint() = default;
  ProximalPoint(const ProximalPoint&) = delete;
  ProximalPoint& operator=(const ProximalPoint&) = delete;
  StaticSolution run();

  /// How accurate a contact solve must be while the residual is large: the smaller of `coarse` and `share` of
  /// the residual, as an inexact proximal-point method requires. The first step is
  /// `first_step` times that of first_static_step(), as far as the compliance permits.
  struct Pace {
    int max_solves;
    double coarse, share, first_step = 1.0;
    /// The search ends at an iterate with a larger residual. Relative to a block's weight.
    double largest_residual = std::numeric_limits<double>::infinity();
  };

 protected:
  ProximalPoint(const Model& model, const State& start, const ContactSet& contacts,
                const ContactMemories& memories, const StaticOptions& options, const Pace& pace);

  /// One contact solve, or several under a control, from the last iterate.
  virtual void iterate() = 0;
  /// A shorter step makes the contact problem easier, because inertia carries a larger share. False if this
  /// was tried often enough.
  virtual bool shorten_step() = 0;
  /// Adapts the step to the contraction of the last iteration.
  virtual void adapt(double contraction) = 0;
  /// True where the verdict on a motion is to be sought.
  virtual bool may_be_moving(double contraction) const { return contraction > kNoProgress; }
  /// That verdict. None: go on.
  virtual std::optional<StaticSolution> judge_motion(double contraction) = 0;
  /// The last iterate becomes the start of the next one. Returns by how much it reduced the residual.
  virtual double advance();
  virtual bool accepts(const StaticSolution& trial) const;
  virtual StaticSolution give_up(int num_solves);

  void set_step(double h);
  ContactSolverOptions solve_options() const;
  void attempt(const ContactSolverOptions& solve, const VecX& before, const VecX& free);
  StaticSolution finish(StaticOutcome outcome, std::string message);
  StaticSolution finish_moving(const std::string& way);
  std::string acceleration_text() const;

  const Model& model_;
  const State& start_;
  const ContactSet& contacts_;
  const ContactMemories& memories_;
  StaticOptions options_;      // under a control: at the time tried last
  const double acceleration_;  // m/s2, reference
  double largest_h_;           // s; infinite: some contact is rigid
  StepProblem step_;           // at trial_.h; its v_star is the free velocity at rest, h M^-1 w
  ContactSolution x_;          // last accepted iterate, at trial_.h
  StaticSolution trial_;       // without the contact problem, which is large
  VecX moved_;                 // m, rad: displacement of the last iteration (6 nb)
  double residual_ = 1.0;      // equilibrium residual of x_; at the start, of the unsupported structure
  int num_shortened_ = 0;

 private:
  bool is_accurate_enough() const;
  std::optional<StaticSolution> judge_failed_solve();
  StaticSolution finish_accepted();

  const Pace pace_;
  ContactSolver solver_;
  StaticSolution best_;  // without the contact problem
};

}  // namespace cupola
