#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// A speed ratio smaller than that of any mechanism whose load exceeds the critical one by a millionth.
constexpr double kAtRest = 1e-6;

/// Part of the tolerance for the contact solve; inertia takes the rest.
constexpr double kSolveShare = 0.1;

/// Mean block weight over the largest load on a block. The equilibrium residual is relative to the former,
/// the residual of a contact solve to the latter, which is far larger where small blocks carry large loads.
double weight_over_load(const Model& model, double acceleration);

/// The proximal-point iteration of one scene (static_solve.hpp). A non-associated law with compliant joints follows a path by
/// pseudo-transient continuation.
class ProximalPoint {
 public:
  ProximalPoint(const Model& model, const State& start, const ContactSet& contacts,
                const ContactMemories& memories, const StaticOptions& options);

  /// Starts from the displacements and forces of another solve of the same scene instead of following a path.
  void start_from(const StaticSolution& other) {
    follows_path_ = false;
    set_step(other.h);
    x_ = other.step_solution;
  }
  StaticSolution run();

 private:
  void set_step(double h);
  double solve_tolerance() const;
  void iterate();
  void attempt(const ContactSolverOptions& solve, const VecX& before, const VecX& free);
  double control_share() const;
  void seek_time(double tolerance, const std::function<void()>& attempt_now);
  bool misses_displacement(const StaticSolution& trial) const;
  bool accepts(const StaticSolution& trial) const;
  bool is_accurate_enough(const StaticSolution& trial) const;
  bool shorten_step();
  void speed_up(double contraction);
  double proof(const StaticSolution& trial) const;
  bool moves_steadily(double contraction, int count);
  bool moves_far();
  double advance();
  std::optional<StaticSolution> judge_motion(double contraction);
  std::optional<StaticSolution> judge_failed_solve();
  StaticSolution finish_accepted();
  StaticSolution finish(StaticOutcome outcome, std::string message);

  const Model& model_;
  const State& start_;
  const ContactSet& contacts_;
  const ContactMemories& memories_;
  StaticOptions options_;  // under a control: at the time tried last
  const bool associated_;
  bool follows_path_ = false;  // solve_static(): non-associated law, compliant joints, Newton's method
  const double acceleration_;  // m/s2, reference
  const double largest_h_;     // s
  ContactSolver solver_;
  StepProblem step_;             // at trial_.h; its v_star is the free velocity at rest, h M^-1 w
  ContactSolution x_;            // last accepted iterate, at trial_.h
  StaticSolution trial_, best_;  // without the contact problem, which is large
  double residual_ = 1.0;        // equilibrium residual of x_; at the start, of the unsupported structure
  double tightening_ = 1.0;      // factor on the tolerance of the contact solves
  int num_shortened_ = 0, num_steady_ = 0;
  double settlement_ = 0.0;                                    // m, largest displacement of the first iterate
  double failed_h_ = std::numeric_limits<double>::infinity();  // s, step at which Newton failed last
  double lowest_residual_ = std::numeric_limits<double>::infinity();  // steps of a quarter
  double travel_ = 0.0;      // m, sum of the largest displacements since lowest_residual_
  VecX moved_;               // m, rad: displacement of the last iteration (6 nb)
  VecX flow_;                // m/s2: moved_ / h^2 while the path is far from equilibrium, else empty
  double reached_ = 0.0;     // m, control: displacement beyond the one asked for
  double time_slope_ = 0.0;  // m/s, control: change of the displacement with the time; 0: unknown
};

}  // namespace cupola
