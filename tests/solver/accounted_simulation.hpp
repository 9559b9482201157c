#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solver/analysis/motion/dynamic_history.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/simulation.hpp"

namespace cupola::testing {

/// A simulation that throws std::runtime_error unless its account of energy closes in every step: to 1e-6 of
/// what was dissipated, or of the peak of the kinetic or the elastic energy.
class AccountedSimulation : public Simulation {
 public:
  using Simulation::Simulation;
  AccountedSimulation(const Case& scene, const Assembly& assembly)
      : Simulation(make_simulation(scene, assembly)) {}

  StepReport advance(double h_max = std::numeric_limits<double>::infinity()) {
    if (std::exchange(starts_, false)) {
      account_ = {};
      account_.start = energy().total();
    }
    StepReport report = Simulation::advance(h_max);
    account_.include(report);
    peak_elastic_ = std::max(peak_elastic_, report.energy.elastic);
    // The potential energy is known to the rounding of the positions: two a step, of a few metres.
    rounding_ += 2.0 * kPosition * report.balance.applied_load.norm();
    const double scale = std::max({account_.work.dissipated(), account_.peak_kinetic, peak_elastic_});
    if (!(std::abs(account_.error) <= 1e-6 * scale + rounding_))
      throw std::runtime_error(fmt::format("the account of energy errs by {:.2e} J of {:.2e} J after {:g} s",
                                           account_.error, scale, state().time));
    return report;
  }
  State* mutable_state() {
    starts_ = true;
    return Simulation::mutable_state();
  }
  void start_from(const LoadedState& loaded) {
    starts_ = true;
    Simulation::start_from(loaded);
  }
  void restore(const std::string& bytes) {
    starts_ = true;
    Simulation::restore(bytes);
  }

 private:
  static constexpr double kPosition = 8.0 * std::numeric_limits<double>::epsilon();  // m
  RunEnergy account_;
  double peak_elastic_ = 0.0, rounding_ = 0.0;  // J
  bool starts_ = true;
};

}  // namespace cupola::testing
