#include "tests/verification/rocking_block.hpp"

#include <cmath>
#include <stdexcept>

#include "tests/verification/motion.hpp"

namespace cupola::verification {
namespace {

/// Rotates the block by `angle` (rad, about y) over its lower edge at +x.
void tip(double b, double H, double angle, State* state) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  state->poses[1].q_WB = turn;
  state->poses[1].p_WB = Vec3(b, 0, 0) + turn * Vec3(-b, 0, H);
}

double tilt_of(const State& state) {
  return 2.0 * std::atan2(state.poses[1].q_WB.y(), state.poses[1].q_WB.w());
}

}  // namespace

RockingImpact rock_until_impact(double b, double H, double share, double h) {
  Case scene = testing::make_case(0.8, 1e-12, h);
  scene.analysis.tolerance = 1e-9;
  Motion motion(scene, testing::box_on_floor({2 * b, 1.0, 2 * H}));
  auto& simulation = motion.simulation;
  tip(b, H, share * std::atan(b / H), simulation.mutable_state());
  while (simulation.state().time < 2.0) {
    const double before = simulation.state().v[4];
    simulation.advance();
    if (tilt_of(simulation.state()) > 0.0) continue;
    RockingImpact impact{simulation.state().time, -before, 0.0};
    for (int step = 0; step < 5; ++step) simulation.advance();
    impact.ratio = simulation.state().v[4] / before;
    return impact;
  }
  throw std::runtime_error("the block did not return within 2 s");
}

}  // namespace cupola::verification
