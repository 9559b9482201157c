#include "solver/analysis/motion/rest_window.hpp"

#include <algorithm>

namespace cupola {

void RestWindow::include(const Model& model, const State& state, const Analysis::Thresholds& thresholds) {
  constexpr double kSamplesPerWindow = 8.0;
  time_ = state.time;
  const double speed = largest_speed(state.v);
  if (!(speed <= thresholds.speed)) {
    last_fast_time_ = time_;
    last_fast_speed_ = speed;
  }
  std::vector<Vec3> centroids;
  centroids.reserve(model.free_blocks.size());
  for (const int block : model.free_blocks) centroids.push_back(state.poses[block].p_WB);

  while (samples_.size() > 1 && samples_[1].time <= time_ - thresholds.window)
    samples_.erase(samples_.begin());
  drift_ = 0.0;
  const bool spans =
      thresholds.window > 0.0 && !samples_.empty() && samples_.front().time <= time_ - thresholds.window;
  if (spans)
    for (size_t i = 0; i < centroids.size(); ++i)
      drift_ = std::max(
          drift_, (centroids[i] - samples_.front().centroids[i]).norm() / (time_ - samples_.front().time));
  if (samples_.empty() || time_ - samples_.back().time >= thresholds.window / kSamplesPerWindow)
    samples_.push_back({time_, std::move(centroids)});
}

bool RestWindow::is_slow(const Analysis::Thresholds& thresholds) const {
  return last_fast_time_ < 0.0 || (last_fast_time_ < time_ && last_fast_time_ <= time_ - thresholds.window);
}

}  // namespace cupola
