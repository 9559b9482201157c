// Orders of convergence, refinement and tolerances.

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "generators/generate.hpp"
#include "tests/verification/motion.hpp"
#include "tests/verification/rocking_block.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/thrust.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

using testing::kG;
using testing::make_case;

/// log2 of the error at twice the step over the error at the step.
double observed_order(double step, const std::function<double(double)>& error) {
  return std::log2(std::abs(error(2.0 * step) / error(step)));
}

/// Height of a cube on springs, w = 20 rad/s, after 0.05 s.
double spring_height(double h, double alpha) {
  Motion motion(make_case(0.4, 1e-5, h, alpha), testing::box_on_floor({1, 1, 1}));
  motion.advance(static_cast<int>(std::lround(0.05 / h)));
  return motion.state().poses[1].p_WB.z() - 0.5;
}

/// Exact motion of y'' = -g - w^2 (y + alpha y') from rest.
double exact_spring_height(double alpha) {
  const double w = 20.0, t = 0.05, zeta = 0.5 * alpha * w, wd = w * std::sqrt(1.0 - zeta * zeta);
  return -kG / (w * w) *
         (1.0 - std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t)));
}

double spring_error(double h, double alpha) {
  return spring_height(h, alpha) - exact_spring_height(alpha);
}

/// Energy lost by a sliding block beyond the work of friction, over that work.
double sliding_energy_error(double h) {
  Case scene = make_case(0.2, 1e-10, h);
  scene.loads.gravity = testing::tilted_gravity(0.5);
  Motion motion(scene, testing::box_on_floor({1.0, 0.5, 0.2}));
  auto& simulation = motion.simulation;
  double work = 0.0;
  const double start = simulation.energy().total();
  while (simulation.state().time < 0.5) work += simulation.advance().work.friction;
  return (start - simulation.energy().total() - work) / work;
}

/// Relative change of the energy of a free rotation within 1 s.
double tumbling_energy_error(double h) {
  Case scene = make_case(0.4, 1e-8, h);
  scene.loads.gravity.setZero();
  Motion motion(scene, testing::make_boxes({{.center = {0, 0, 50}, .size = {1, 2, 3}}}));
  auto& simulation = motion.simulation;
  simulation.mutable_state()->v << 1, 0, 0, 0.3, 2.0, 0.1;
  const double start = simulation.energy().total();
  while (simulation.state().time < 1.0) simulation.advance();
  return simulation.energy().total() / start - 1.0;
}

double order(const ReferenceRow& row) {
  const std::string scene = row.text("scene");
  if (scene == "spring") return observed_order(1e-4, [](double h) { return spring_error(h, 0.0); });
  if (scene == "damped spring") return observed_order(1e-4, [](double h) { return spring_error(h, 5e-3); });
  if (scene == "sliding") return observed_order(1e-3, sliding_energy_error);
  if (scene == "tumbling") return observed_order(1e-3, tumbling_energy_error);
  const double undamped = spring_height(1e-4, 0.0);
  if (scene == "damping")
    return observed_order(1e-4, [&](double alpha) { return spring_height(1e-4, alpha) - undamped; });
  throw std::runtime_error("unknown scene " + scene);
}

double order_of_facets(const ReferenceRow&) {
  const auto error = [](double size) {  // relative to 10 x 16
    Case scene;
    const int factor = static_cast<int>(std::lround(1.0 / size));
    scene.geometry.bond = RunningBond{10 * factor, 16 * factor, 2};
    GenerateReport report;
    generate(scene, &report);
    return report.model.volume / 9231.922780 - 1.0;  // smooth shell, by quadrature
  };
  return observed_order(0.5, error);
}

double thrust_of_bricks(int refine) {
  const Case scene = repository_case(
      "dome_circular", {"joints.compliance.per=area", "geometry.bond.refine=" + std::to_string(refine)});
  const Assembly dome = generate(scene);
  return outward_thrust(dome, solve_equilibrium(scene, dome).frame.contacts);
}

double ratio_of_changes(const ReferenceRow&) {
  const double one = thrust_of_bricks(1), two = thrust_of_bricks(2), four = thrust_of_bricks(4);
  return (two - one) / (four - two);
}

/// Mean settlement of the last ring, m.
double crown_settlement(int cells) {
  const Case scene = repository_case(
      "dome_circular",
      {"joints.compliance.per=area", "geometry.bond.slices_per_block=" + std::to_string(cells)});
  const Assembly dome = generate(scene);
  const Equilibrium solved = solve_equilibrium(scene, dome);
  double sum = 0.0;
  for (int b = static_cast<int>(dome.blocks.size()) - 32; b < static_cast<int>(dome.blocks.size()); ++b)
    sum -= solved.frame.blocks.displacement[b].z();
  return sum / 32;
}

/// Quarter period of the first row of the problem `housner`, whose reference is the exact motion.
double rocking_error(const ReferenceRow& row) {
  const double exact = reference("housner").rows.front().expected();
  return rock_until_impact(0.2, 1.0, 0.5, row.number("h_s")).time / exact - 1.0;
}

/// Root mean square difference of the joint forces from those at tolerance 1e-10, over their root mean
/// square.
double error_of_tolerance(const ReferenceRow& row) {
  const auto forces_at = [](const std::string& tolerance) {
    const Case scene = repository_case("dome_circular", {"analysis.tolerance=" + tolerance});
    return joint_forces(solve_equilibrium(scene, generate(scene)).frame);
  };
  const JointForces exact = forces_at("1e-10");
  double difference = 0.0, size = 0.0;
  for (const auto& [pair, force] : forces_at(row.text("asked"))) {
    difference += (force - exact.at(pair)).squaredNorm();
    size += exact.at(pair).squaredNorm();
  }
  return std::sqrt(difference / size);
}

}  // namespace

void add_convergence_rows(Computations* all) {
  Computations& rows = *all;
  rows["order"] = order;
  rows["facet_order"] = order_of_facets;
  rows["refinement"] = ratio_of_changes;
  rows["settlement_points"] = [](const ReferenceRow& row) {
    return crown_settlement(row.integer("cells")) / crown_settlement(4);
  };
  rows["step_error"] = rocking_error;
  rows["tolerance_error"] = error_of_tolerance;
}

}  // namespace cupola::verification
