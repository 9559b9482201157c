// Errors of the time integrators on scenes of one block, as CSV: scene, integrator, step (ms), relative
// error.

#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "assembly/program/program.hpp"
#include "tests/arguments.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace {

using namespace cupola;
using testing::kG;
using testing::make_case;

constexpr double kSteps[] = {0.02, 0.01, 0.005, 0.0025, 0.00125};  // s

State state_after(double time, Case scene, TimeIntegrator integrator, const Assembly& assembly,
                  const std::function<void(State*)>& set_up = {}) {
  scene.analysis.integrator = integrator;
  Simulation simulation = testing::simulate(scene, assembly);
  if (set_up) set_up(simulation.mutable_state());
  while (simulation.state().time < time * (1.0 - 1e-9)) simulation.advance();
  return simulation.state();
}

/// Height of a cube on springs, w = 20 rad/s, released at rest, after 0.2 s, against the exact motion.
double spring_error(TimeIntegrator integrator, double h) {
  const double w = 20.0, exact = -kG / (w * w) * (1.0 - std::cos(w * 0.2));
  const State state = state_after(0.2, make_case(0.4, 1e-5, h), integrator, testing::box_on_floor({1, 1, 1}));
  return (state.poses[1].p_WB.z() - 0.5) / exact - 1.0;
}

/// Way of a block with friction 0.2 down a slope of 0.5 in 0.5 s under Coulomb's law, against the exact
/// motion.
double sliding_error(TimeIntegrator integrator, double h) {
  Case scene = make_case(0.2, 1e-9, h);
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.loads.gravity = testing::tilted_gravity(0.5);
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
  const double a = std::atan(0.5), exact = 0.5 * kG * (std::sin(a) - 0.2 * std::cos(a)) * 0.5 * 0.5;
  const State state = state_after(0.5, scene, integrator, assembly);
  return (state.poses[1].p_WB.x() - assembly.blocks[1].centroid.x()) / exact - 1.0;
}

/// Angle of a block of 0.4 m x 2 m, released from half of its angle of overturning, after 0.4 s.
double rocking_angle(TimeIntegrator integrator, double h) {
  const auto tip = [](State* state) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5 * std::atan(0.2), Vec3::UnitY()));
    state->poses[1] = {Vec3(0.2, 0, 0) + turn * Vec3(-0.2, 0, 1.0), turn};
  };
  const State state =
      state_after(0.4, make_case(0.8, 1e-10, h), integrator, testing::box_on_floor({0.4, 1.0, 2.0}), tip);
  return 2.0 * std::atan2(state.poses[1].q_WB.y(), state.poses[1].q_WB.w());
}

/// Against the exact angle, extrapolated from steps a hundred times finer than the longest.
double rocking_error(TimeIntegrator integrator, double h) {
  const auto exact = [] {
    const double fine = rocking_angle(TimeIntegrator::generalized_alpha, 1e-4);
    return fine + (fine - rocking_angle(TimeIntegrator::generalized_alpha, 2e-4)) / 3.0;
  };
  static const double angle = exact();
  return rocking_angle(integrator, h) / angle - 1.0;
}

void print_table() {
  fmt::print("scene,integrator,step ms,error\n");
  const std::pair<const char*, double (*)(TimeIntegrator, double)> scenes[] = {
      {"cube on springs", spring_error}, {"sliding block", sliding_error}, {"rocking block", rocking_error}};
  for (const auto& [name, error] : scenes)
    for (const TimeIntegrator integrator : {TimeIntegrator::euler, TimeIntegrator::generalized_alpha})
      for (const double h : kSteps)
        fmt::print("{},{},{:g},{:.3e}\n", name, to_string(integrator), 1e3 * h,
                   std::abs(error(integrator, h)));
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("integrator_benchmark", [&] {
    read_arguments(argc, argv, 0, 0, "integrator_benchmark");
    print_table();
    return ExitCode::done;
  });
}
