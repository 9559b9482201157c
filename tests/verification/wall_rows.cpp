// Walls of equal blocks.

#include <cmath>
#include <stdexcept>

#include "generators/generate.hpp"
#include "tests/solver/motion_scenes.hpp"
#include "tests/verification/one_step.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

/// Settlement of the top course over the compliance, N. All its blocks must sink by the same.
double settlement_over_compliance(const ReferenceRow& row) {
  const double c = row.number("compliance");
  Case scene;
  RunningBond bond;
  bond.rings = row.integer("courses");
  bond.blocks_per_ring = row.integer("blocks_per_course");
  bond.slices_per_block = 2;
  scene.geometry.surface = WallSurface{12.0, 6.0, 1.0};
  scene.geometry.bond = bond;
  scene.material.unit_weight = 1800.0 * 9.81;
  scene.joints.compliance = {c, c, Compliance::Per::point};
  scene.loads.top_load = TopLoad{10.0};
  const Assembly wall = generate(scene);
  const Equilibrium solved = solve_equilibrium(scene, wall);
  double least = 1e300, most = 0.0;
  for (size_t i = 0; i < wall.blocks.size(); ++i) {
    if (wall.blocks[i].ring != bond.rings - 1) continue;
    const double sunk = -solved.frame.blocks.displacement[i].z() / c;
    least = std::min(least, sunk);
    most = std::max(most, sunk);
  }
  if (most - least > 1e-6 * most) throw std::runtime_error("the top course does not stay level");
  return most;
}

double critical_load(int courses, bool whole_first) {
  return critical_value(limit_case(LimitSearch::Parameter::acceleration, 0.3, 0.9, 0.65),
                        testing::ferris_wall(courses, whole_first));
}

/// Wall 3 of Ferris and Tin-Loi (2001): courses from the bottom, lengths in blocks of 0.4 m, an opening
/// negative.
Assembly wall_with_window() {
  constexpr double kLength = 0.4, kHeight = 0.175;  // m
  using Course = std::vector<double>;
  const Course fe{1, 1, 1, 1}, fu{0.5, 1, 1, 1, 0.5}, we{1, 0.5, -1, 0.5, 1}, wu{0.5, 1, -1, 1, 0.5};
  std::vector<testing::BoxSpec> boxes{{.center = {0.8, 0.5, -0.5}, .size = {6, 2, 1}, .fixed = true}};
  int ring = 0;
  for (const Course* course : {&fe, &fu, &fe, &wu, &we, &wu, &we, &wu, &fe, &fu, &fe}) {
    double low = 0.0;
    for (const double length : *course) {
      const double high = low + kLength * std::abs(length);
      if (length > 0.0)
        boxes.push_back({.center = {0.5 * (low + high), 0.5, (ring + 0.5) * kHeight},
                         .size = {high - low, 1, kHeight},
                         .ring = ring});
      low = high;
    }
    ++ring;
  }
  return testing::make_boxes(boxes);
}

}  // namespace

void add_wall_rows(Computations* all) {
  Computations& rows = *all;
  rows["paper_wall"] = settlement_over_compliance;
  rows["one_step_wall"] = [](const ReferenceRow& row) {
    return speed_after_one_step(testing::ferris_wall(6, false), 0.65,
                                testing::tilted_gravity(row.number("lambda")));
  };
  rows["ferris_wall"] = [](const ReferenceRow& row) {
    return critical_load(row.integer("courses"), row.text("first_course") == "whole blocks");
  };
  rows["two_leaf_wall"] = [](const ReferenceRow& row) {
    const Case scene = repository_case(row.text("case"));
    return critical_value(scene, generate(scene));
  };
  rows["ferris_published"] = [](const ReferenceRow& row) {
    const int wall = row.integer("wall");
    Case scene = limit_case(LimitSearch::Parameter::acceleration, 0.3, 0.9, 0.65);
    if (row.text("law") == "coulomb") scene.analysis.friction_law = FrictionLaw::coulomb;
    return critical_value(scene,
                          wall == 3 ? wall_with_window() : testing::ferris_wall(wall == 1 ? 6 : 10, false));
  };
}

}  // namespace cupola::verification
