#pragma once

#include <utility>

#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::verification {

/// A simulation together with the assembly to which it refers.
struct Motion {
  Motion(const Case& scene, Assembly blocks) : assembly(std::move(blocks)), simulation(scene, assembly) {}
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  void advance(int steps) {
    for (int step = 0; step < steps; ++step) simulation.advance();
  }
  const State& state() const { return simulation.state(); }

  Assembly assembly;
  testing::AccountedSimulation simulation;
};

}  // namespace cupola::verification
