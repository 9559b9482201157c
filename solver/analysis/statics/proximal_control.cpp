#include <algorithm>
#include <cmath>

#include "solver/analysis/statics/proximal_point.hpp"

// Iterations under a control of the length of a path: each finds its time (length_control.hpp).

namespace cupola {

/// By how much the next iterate may miss the control displacement, over g h^2: in the iteration after it, the rest appears as
/// inertia.
double ProximalPoint::control_share() const {
  constexpr double kShare = 1e-2;  // of the residual, and of the displacement
  const double largest = kShare * options_.control->displacement / (trial_.h * trial_.h * acceleration_);
  return std::min(largest, std::max(kSolveShare * options_.tolerance, kShare * residual_) *
                               weight_over_load(model_, acceleration_));
}

/// Finds the time at which the iterate has the control displacement, to a tolerance (m).
void ProximalPoint::seek_time(double tolerance, const std::function<void()>& attempt_now) {
  const LengthControl& control = *options_.control;
  std::optional<double> last_time;
  const auto missing = [&](double time) -> std::optional<double> {
    if (time - start_.time != options_.time_advance) {
      options_.time_advance = time - start_.time;
      set_step(trial_.h);
    }
    attempt_now();
    if (!trial_.solve.usable()) return std::nullopt;
    const double before = reached_;
    reached_ = control_displacement(model_, start_, control, time, trial_.h * trial_.step_solution.v) -
               control.displacement;
    if (last_time) time_slope_ = std::abs((reached_ - before) / (time - *last_time));
    last_time = time;
    return reached_;
  };
  RootSearch search{control.earliest,  control.latest, start_.time + options_.time_advance,
                    control.time_step, time_slope_,    tolerance};
  find_root(search, missing);
}

/// True if no time gave the control displacement. At the latest time it may be missing.
bool ProximalPoint::misses_displacement(const StaticSolution& trial) const {
  constexpr double kMiss = 0.1;  // of the displacement of a step
  if (!options_.control || std::abs(reached_) <= kMiss * options_.control->displacement) return false;
  return reached_ > 0.0 || trial.time_advance != options_.control->latest - start_.time;
}

}  // namespace cupola
