#pragma once

#include <functional>
#include <limits>

#include "solver/analysis/statics/proximal_point.hpp"

namespace cupola {

/// The proximal-point iteration by pseudo-transient continuation, for non-associated laws and compliant
/// joints (static_solve.hpp): many coarse solves, whose step follows the iterations that Newton's method
/// needs.
class FollowingPath : public ProximalPoint {
 public:
  /// `least_motion`: m, by which blocks must move before their motion is called steady. `shortcut`: seeks an
  /// equilibrium elsewhere, once, where they have moved by many settlements, but less.
  FollowingPath(const Model& model, const State& start, const ContactSet& contacts,
                const ContactMemories& memories, const StaticOptions& options, double least_motion,
                std::function<StaticSolution()> shortcut);

 private:
  void iterate() override;
  bool shorten_step() override;
  void adapt(double contraction) override;
  std::optional<StaticSolution> judge_motion(double contraction) override;
  double advance() override;

  bool moves_slowly();

  const double least_motion_;
  std::function<StaticSolution()> shortcut_;                   // empty: tried, or none
  double settlement_ = 0.0;                                    // m, largest displacement of the first iterate
  double failed_h_ = std::numeric_limits<double>::infinity();  // s, step at which Newton failed last
  double lowest_residual_ = std::numeric_limits<double>::infinity();  // steps of a quarter
  double travel_ = 0.0;  // m, sum of the largest displacements since lowest_residual_
  VecX flow_;            // m/s2: moved_ / h^2 while the path is far from equilibrium, else empty
};

}  // namespace cupola
