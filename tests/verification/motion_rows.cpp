// Blocks in motion.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/verification/motion.hpp"
#include "tests/verification/rocking_block.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

using testing::kG;
using testing::make_case;

/// The block on an incline after some steps of 0.01 s.
State slide(double tan_slope, int steps) {
  const Assembly block = testing::box_on_floor({1.0, 0.5, 0.2});
  const double h = 0.01;
  Case scene = make_case(0.4, 1e-12 * h * h / block.blocks[1].mass, h);
  scene.loads.gravity = testing::tilted_gravity(tan_slope);
  Motion motion(scene, block);
  motion.advance(steps);
  return motion.state();
}

double sliding_speed(const ReferenceRow& row) {
  return slide(0.5, row.integer("step")).v[0];
}

double sliding_gap(const ReferenceRow& row) {
  return slide(0.5, row.integer("step")).poses[1].p_WB.z() - 0.1;
}

double sliding_acceleration(const ReferenceRow& row) {
  const double tan_slope = std::tan(row.number("slope_deg") * kRadians);
  return (slide(tan_slope, 20).v[0] - slide(tan_slope, 19).v[0]) / 0.01;
}

double spring_speed(const ReferenceRow& row) {
  Motion motion(make_case(0.4, 2e-6, 0.002, row.number("alpha_s")), testing::box_on_floor({1, 1, 1}));
  motion.advance(row.integer("step"));
  return motion.state().v[2];
}

/// A prism between two fixed planes that slope by 30 deg and meet in a groove along y.
Assembly groove() {
  const double slope = std::tan(30.0 * kRadians), foot = 0.05, head = 0.5;
  const auto height = [&](double x) { return slope * (x - foot); };
  Assembly assembly;
  assembly.title = "groove";
  testing::add_voussoir({Eigen::Vector2d{foot, -1}, {1, -1}, {1, height(1)}, {foot, 0}}, 12.0, 1000.0, true,
                        0, &assembly);
  testing::add_voussoir({Eigen::Vector2d{-1, -1}, {-foot, -1}, {-foot, 0}, {-1, height(1)}}, 12.0, 1000.0,
                        true, 0, &assembly);
  testing::add_voussoir({Eigen::Vector2d{-foot, 0}, {foot, 0}, {head, height(head)}, {-head, height(head)}},
                        2.0, 1000.0, false, 0, &assembly);
  compute_mass_properties(&assembly);
  return assembly;
}

double critical_groove_tilt(const ReferenceRow& row) {
  Case scene = limit_case(LimitSearch::Parameter::tilt, 30.0, 60.0, 0.84);
  scene.analysis.limit.direction = Vec3(0, 1, 0);
  if (row.text("law") == "coulomb") scene.analysis.friction_law = FrictionLaw::coulomb;
  return critical_value(scene, groove());
}

/// Mean acceleration of the prism along the groove in the third second after `start` (s).
double acceleration_in_third_second(testing::AccountedSimulation* simulation, double start) {
  while (simulation->state().time < start + 2.0 - 5e-3) simulation->advance();
  const double before = simulation->state().v[1];
  while (simulation->state().time < start + 3.0 - 5e-3) simulation->advance();
  return simulation->state().v[1] - before;
}

double groove_acceleration(const ReferenceRow& row) {
  const double tilt = row.number("tilt_deg") * kRadians;
  Case scene = make_case(0.84, 0.0, 0.01);
  scene.loads.gravity = kG * Vec3(0, std::sin(tilt), -std::cos(tilt));
  Motion motion(scene, groove());
  const double start = row.number("start");
  if (start > 0.0) {
    motion.advance(1);
    if (motion.state().v.norm() > 1e-8) throw std::runtime_error("does not stay at rest from rest");
    motion.simulation.mutable_state()->v[1] = start;
  }
  return acceleration_in_third_second(&motion.simulation, motion.state().time);
}

double force_over_weight_above(const ReferenceRow& row) {
  const double ratio = row.number("ratio"), depth = 1e-5, W = 1000.0 * kG;
  const int joint = row.integer("joint");
  Case scene = make_case(0.4, 4.0 * depth / (W * (2 + ratio)), 0.01);
  scene.analysis.tolerance = 1e-9;
  Motion motion(scene, testing::stack_of_cubes(1.0, {1000.0, 1000.0, 1000.0 * ratio}));
  auto& simulation = motion.simulation;
  StepReport report;
  for (int step = 0; step < 200; ++step) report = simulation.advance();
  double force = 0.0;
  for (size_t i = 0; i < report.forces.contacts.size(); ++i)
    if (simulation.contacts().points[i].block_a == joint) force += report.forces.contacts[i].z();
  return force / (W * (2 - joint + ratio));
}

/// Position and extreme speeds of a block of 1 kg driven by 8 cos t, to the given time.
struct DrivenBlock {
  double x = 0.0, smallest = 0.0, largest = 0.0;
};
DrivenBlock drive(double until) {
  Case scene = make_case(0.8, 1e-10, 1e-3);
  scene.analysis.tolerance = 1e-9;
  HarmonicInTime cosine{.frequency = 0.5 / std::numbers::pi, .phase_deg = 90.0};
  scene.loads.forces = {{.block = 1, .point = Vec3(0, 0, 0), .force = Vec3(8, 0, 0), .time = cosine}};
  Motion motion(scene, testing::box_on_floor({0.3, 0.3, 0.1}, 1.0 / (0.3 * 0.3 * 0.1)));
  auto& simulation = motion.simulation;
  DrivenBlock driven;
  while (simulation.state().time < until - 5e-4) {
    simulation.advance();
    driven.largest = std::max(driven.largest, simulation.state().v[0]);
    driven.smallest = std::min(driven.smallest, simulation.state().v[0]);
  }
  driven.x = simulation.state().poses[1].p_WB.x();
  return driven;
}

double rocking_quantity(const ReferenceRow& row) {
  const RockingImpact impact = rock_until_impact(row.number("b"), row.number("H"), row.number("share"), 2e-4);
  const std::string quantity = row.text("quantity");
  return quantity == "quarter period" ? impact.time : quantity == "speed" ? impact.speed : impact.ratio;
}

}  // namespace

void add_motion_rows(Computations* all) {
  Computations& rows = *all;
  rows["incline_speed"] = sliding_speed;
  rows["incline_gap"] = sliding_gap;
  rows["incline_stick"] = sliding_acceleration;
  rows["implicit_spring"] = spring_speed;
  rows["groove_tilt"] = critical_groove_tilt;
  rows["groove_acceleration"] = groove_acceleration;
  rows["mass_ratio"] = force_over_weight_above;
  rows["housner"] = rocking_quantity;
  rows["stick_slip_position"] = [](const ReferenceRow& row) { return drive(row.number("time_s")).x; };
  rows["stick_slip_speed"] = [](const ReferenceRow& row) {
    const DrivenBlock driven = drive(10.0);
    return row.text("extreme") == "smallest" ? driven.smallest : driven.largest;
  };
}

}  // namespace cupola::verification
