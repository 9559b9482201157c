#include "solver/analysis/motion/rest_window.hpp"

#include "solver/analysis/motion/farthest_point.hpp"

namespace cupola {

void RestWindow::include(const CollisionModel& shapes, const Model& model, const State& state, double speed,
                         const Analysis::Thresholds& thresholds) {
  constexpr double kSamplesPerWindow = 8.0;
  time_ = state.time;
  if (!(speed <= thresholds.speed)) {
    last_fast_time_ = time_;
    last_fast_speed_ = speed;
  }
  while (samples_.size() > 1 && samples_[1].time <= time_ - thresholds.window)
    samples_.erase(samples_.begin());
  drift_ = 0.0;
  const bool spans =
      thresholds.window > 0.0 && !samples_.empty() && samples_.front().time <= time_ - thresholds.window;
  if (spans)
    drift_ =
        farthest_point(shapes, model, samples_.front().poses, state.poses) / (time_ - samples_.front().time);
  if (samples_.empty() || time_ - samples_.back().time >= thresholds.window / kSamplesPerWindow)
    samples_.push_back({time_, state.poses});
}

bool RestWindow::is_covered(const Analysis::Thresholds& thresholds) const {
  constexpr double kRounding = 1e-9;  // of the sum of the steps
  return time_ >= (1.0 - kRounding) * thresholds.window;
}

bool RestWindow::is_slow(const Analysis::Thresholds& thresholds) const {
  return last_fast_time_ < 0.0 || (last_fast_time_ < time_ && last_fast_time_ <= time_ - thresholds.window);
}

}  // namespace cupola
