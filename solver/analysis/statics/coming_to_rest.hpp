#pragma once

#include <functional>
#include <vector>

#include "solver/analysis/statics/proximal_point.hpp"
#include "solver/conic/motion_proof.hpp"

namespace cupola {

/// The proximal-point iteration with steps as long as the compliance permits: a few accurate solves. Under a
/// control each iteration also finds its time (length_control.hpp).
class ComingToRest : public ProximalPoint {
 public:
  /// How far the equilibrium may be. Nearby: the first step is long. Associated: it starts from the equilibrium
  /// of the associated law, and ends where that does not help.
  enum class Start { afar, nearby, associated };
  ComingToRest(const Model& model, const State& start, const ContactSet& contacts,
               const ContactMemories& memories, const StaticOptions& options, Start from = Start::afar);

  /// Starts from the displacements and forces of another solve of the same scene.
  void start_from(const StaticSolution& other) {
    set_step(other.h);
    x_ = other.step_solution;
  }

  /// Starts from the displacement expected. New blocks stick to their neighbours, and of a large structure the
  /// blocks around them move, too, as if the others were fixed. False if a contact is rigid.
  bool start_near(const NearbyStart& start);

 private:
  void iterate() override;
  double rounding_of_impulses(double reference_speed) const;
  bool shorten_step() override;
  void adapt(double contraction) override;
  bool may_be_moving(double contraction) const override;
  std::optional<StaticSolution> judge_motion(double contraction) override;
  bool accepts(const StaticSolution& trial) const override;
  StaticSolution give_up(int num_solves) override;

  double control_share() const;
  void seek_time(double tolerance, const std::function<void()>& attempt_now);
  bool misses_displacement(const StaticSolution& trial) const;
  double required_forces() const;
  bool is_proven_to_move();
  bool moves_steadily(double contraction, int count);
  bool is_driven_by_loads() const;

  int num_steady_ = 0;
  double tightening_ = 1.0;                  // factor on the tolerance of the contact solves
  std::optional<MotionProof> motion_proof_;  // made where a motion shows
  double reached_ = 0.0;                     // m, control: displacement beyond the one asked for
  int num_beyond_ = 0;       // control: iterations in a row that went too far at the earliest time
  double time_slope_ = 0.0;  // m/s, control: change of the displacement with the time; 0: unknown
};

}  // namespace cupola
