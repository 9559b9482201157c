// Single blocks at rest, and limits of a few blocks.

#include <cmath>
#include <stdexcept>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/keystone.hpp"
#include "tests/solver/motion_scenes.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

using Parameter = LimitSearch::Parameter;

Vec3 winkler_displacement(double acceleration) {
  const Assembly block = testing::box_on_floor({1.2, 0.7, 0.9});
  Case scene;
  scene.joints.friction = 0.4;
  scene.joints.compliance = {2e-9, 3e-9, Compliance::Per::area};
  scene.loads.gravity = {acceleration, 0.0, -9.81};
  scene.analysis.tolerance = 1e-11;
  return solve_equilibrium(scene, block).frame.blocks.displacement[1];
}

/// A plate on four legs whose centre of gravity, legs included, lies at (0.3, 0.2).
Assembly table() {
  const double a = 0.01;
  Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true}});
  const double plate_mass = 3.0 * 3.0 * 0.2, legs_mass = 4.0 * 4.0 * a * a * 1.0;
  const Vec3 shift = Vec3(0.3, 0.2, 0.0) * (plate_mass + legs_mass) / plate_mass;
  testing::add_box({.center = Vec3(0, 0, 1.1) + shift, .size = {3, 3, 0.2}}, &assembly);
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      testing::add_box_part({.center = {x, y, 0.5}, .size = {2 * a, 2 * a, 1}}, false, false, &assembly);
  compute_mass_properties(&assembly);
  return assembly;
}

double share_of_leg(const ReferenceRow& row) {
  const std::string leg = row.text("leg");
  const Assembly assembly = table();
  Case scene;
  scene.joints.friction = 0.0;
  const double c = row.number("compliance");
  scene.joints.compliance = {c, c, Compliance::Per::point};
  scene.analysis.tolerance = 1e-11;
  const Equilibrium solved = solve_equilibrium(scene, assembly);
  double force = 0.0;
  for (int i = 0; i < solved.frame.contacts.size(); ++i) {
    const Vec3& p = solved.frame.contacts.point[i];
    if ((p.x() > 0) == (leg[0] == '+') && (p.y() > 0) == (leg[1] == '+'))
      force += solved.frame.contacts.force[i].z();
  }
  return force / solved.summary.weight_N;
}

double toppling_tangent(const ReferenceRow& row) {
  const Assembly stack = testing::stack_of_cubes(1.0, std::vector<double>(row.integer("cubes"), 1000.0));
  return std::tan(critical_value(limit_case(Parameter::tilt, 2.0, 40.0, 0.8), stack) * kRadians);
}

double critical_push(const ReferenceRow&) {
  const Assembly block = testing::box_on_floor({2, 2, 0.5});
  Case scene = limit_case(Parameter::load, 0.0, 1.0, 0.45);
  const double W = block.blocks[1].mass * testing::kG;
  scene.loads.forces = {{.block = 1, .point = Vec3(0, 0, 0), .force = Vec3(W, 0, 0), .time = {}}};
  return critical_value(scene, block);
}

/// Stack whose k-th block from the top projects by `factor` / (2 k).
Assembly overhanging_stack(int n, double factor) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.1}, .size = {1, 0.5, 0.2}, .fixed = true}};
  double x = 0.0;
  for (int k = n; k >= 1; --k) {  // from the bottom up
    x += factor * 0.5 / k;
    boxes.push_back({.center = {x, 0, 0.1 + 0.2 * (n - k)}, .size = {1, 0.5, 0.2}, .ring = n - k});
  }
  return testing::make_boxes(boxes);
}

double critical_overhang(const ReferenceRow& row) {
  const int n = row.integer("blocks");
  Case scene = limit_case(Parameter::tilt, 0, 1, 0.5);
  scene.analysis.type = AnalysisType::static_;
  double sum = 0.0;
  for (int k = 1; k <= n; ++k) sum += 0.5 / k;
  return sum * critical_factor(0.9, 1.1,
                               [&](double factor) { return stands(scene, overhanging_stack(n, factor)); });
}

double critical_friction_of_cards(const ReferenceRow& row) {
  const Assembly cards = testing::LeaningCards{.lean = row.number("phi_deg") * kRadians}.assembly();
  return critical_value(limit_case(Parameter::friction, 0.02, 1.0, 0.5), cards);
}

double critical_friction_of_keystone(const ReferenceRow& row) {
  Case scene = limit_case(Parameter::friction, 0.02, 1.0, 0.5);
  if (row.text("method") == "bisection") scene.analysis.limit.method = LimitSearch::Method::bisection;
  return critical_value(scene, testing::keystone(row.number("slope")));
}

/// 1: proven to stand, -1: proven to move, 0: neither, of a static analysis.
double verdict_near_critical_friction(const ReferenceRow& row) {
  const bool is_keystone = row.text("model") == "keystone";
  const testing::LeaningCards cards{.lean = 30.0 * kRadians};
  constexpr double kSlope = 0.5;
  const double critical = is_keystone ? kSlope : cards.critical_friction();
  Case scene = limit_case(Parameter::friction, 0, 1, critical * (1.0 + row.number("distance")));
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.friction_law = row.text("law") == "coulomb" ? FrictionLaw::coulomb : FrictionLaw::associated;
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::point};
  const Status status =
      run_static(scene, is_keystone ? testing::keystone(kSlope) : cards.assembly(), {}).status;
  return status == Status::stable ? 1.0 : status == Status::moving ? -1.0 : 0.0;
}

/// Displacement of the foot of a block that sticks on an incline with stored elastic slip.
double offset_with_memory() {
  const Assembly block = testing::box_on_floor({4, 4, 0.5});
  Case scene = testing::make_case(0.8, 1e-10, 0.01, 0.02);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  testing::AccountedSimulation simulation(scene, block);
  for (int step = 0; step < 2000; ++step) simulation.advance();
  const Pose& pose = simulation.state().poses[1];
  return (pose.p_WB + pose.q_WB * Vec3(0, 0, -0.25)).x();
}

double speed_of_literal_creep() {
  const Assembly block = testing::box_on_floor({4, 4, 0.5});
  Case scene = testing::make_case(0.8, 1e-10, 0.01, 0.02);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.analysis.tangential = TangentialSpring::literal;
  testing::AccountedSimulation simulation(scene, block);
  for (int step = 0; step < 400; ++step) simulation.advance();
  return simulation.state().v[0];
}

double sinking_speed_of_jammed_beam(const ReferenceRow&) {
  const Assembly beam = testing::make_boxes({{.center = {-1.6, 0, 0}, .size = {1, 1, 3}, .fixed = true},
                                             {.center = {1.6, 0, 0}, .size = {1, 1, 3}, .fixed = true},
                                             {.center = {0, 0, 0}, .size = {2.2, 0.5, 0.5}}});
  Case scene = testing::make_case(0.84, 1e-8, 0.01);
  scene.analysis.tangential = TangentialSpring::literal;
  testing::AccountedSimulation simulation(scene, beam);
  for (int step = 0; step < 100; ++step) simulation.advance();
  return -simulation.state().v[2];
}

double corner_share(const ReferenceRow&) {
  const Assembly cubes =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {1, 1, 1}, .density = 1.0, .fixed = true},
                           {.center = {0, 0, 0.5}, .density = 1.0}});
  Case scene;
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::point};
  const Equilibrium solved = solve_equilibrium(scene, cubes);
  double farthest = 0.25;  // of the four corners
  for (const Vec3& force : solved.frame.contacts.force) {
    const double share = force.z() / solved.summary.weight_N;
    if (std::abs(share - 0.25) > std::abs(farthest - 0.25)) farthest = share;
  }
  if (solved.frame.contacts.size() != 4) throw std::runtime_error("not four contacts");
  return farthest;
}

}  // namespace

void add_block_rows(Computations* all) {
  Computations& rows = *all;
  rows["winkler_settlement"] = [](const ReferenceRow& row) {
    return -winkler_displacement(row.number("acceleration")).z();
  };
  rows["winkler_sway"] = [](const ReferenceRow& row) {
    return winkler_displacement(row.number("acceleration")).x();
  };
  rows["table_legs"] = share_of_leg;
  rows["toppling"] = toppling_tangent;
  rows["push"] = critical_push;
  rows["overhang"] = critical_overhang;
  rows["cards"] = critical_friction_of_cards;
  rows["keystone"] = critical_friction_of_keystone;
  rows["near_critical_friction"] = verdict_near_critical_friction;
  rows["tangential_creep"] = [](const ReferenceRow& row) {
    return row.text("scheme") == "memory" ? offset_with_memory() : speed_of_literal_creep();
  };
  rows["jammed_beam"] = sinking_speed_of_jammed_beam;
  rows["unit_cubes"] = corner_share;
}

}  // namespace cupola::verification
