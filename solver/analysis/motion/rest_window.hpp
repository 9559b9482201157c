#pragma once

#include <vector>

#include "assembly/case/analysis.hpp"
#include "solver/dynamics/model.hpp"
#include "solver/dynamics/state_archive.hpp"

namespace cupola {

/// Decides whether a motion has come to rest: over the last `thresholds.window` seconds, so that a turning
/// point is not taken for rest, and without a trend, so that slow creep is not.
class RestWindow {
 public:
  /// After each step. `state`: seen from the ground; `speed`: m/s, of its fastest_point().
  void include(const CollisionModel& shapes, const Model& model, const State& state, double speed,
               const Analysis::Thresholds& thresholds);

  /// The run has lasted as long as the window: a shorter one shows no rest.
  bool is_covered(const Analysis::Thresholds& thresholds) const;
  /// No block has been faster than thresholds.speed in the window, or since the start of a shorter run.
  bool is_slow(const Analysis::Thresholds& thresholds) const;
  /// Mean velocity of the farthest_point() over the window, m/s; 0 in a shorter run.
  double drift() const { return drift_; }
  /// A drift above this counts as a trend: a tenth of thresholds.speed.
  static double largest_drift(const Analysis::Thresholds& thresholds) { return 0.1 * thresholds.speed; }
  /// Largest speed in the last step in which a block was faster than thresholds.speed, m/s, and its time, s.
  double last_fast_speed() const { return last_fast_speed_; }
  double last_fast_time() const { return last_fast_time_; }

  template <class Archive>
  friend void visit(Archive& archive, RestWindow& x) {
    archive(x.time_, x.last_fast_time_, x.last_fast_speed_, x.drift_, x.samples_);
  }

 private:
  struct Sample {
    double time = 0.0;
    std::vector<Pose> poses;
    template <class Archive>
    friend void visit(Archive& archive, Sample& x) {
      archive(x.time, x.poses);
    }
  };

  double time_ = 0.0;
  double last_fast_time_ = -1.0;  // s; negative: never
  double last_fast_speed_ = 0.0;
  double drift_ = 0.0;
  std::vector<Sample> samples_;  // the first is the latest that is older than the window, or the start
};

}  // namespace cupola
