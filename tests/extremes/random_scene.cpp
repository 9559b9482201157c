#include "tests/extremes/random_scene.hpp"

#include <cmath>

#include <fmt/format.h>

#include "tests/extremes/dice.hpp"
#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

/// Courses of random heights, cut at random into blocks; heads and beds are open by up to `gap`.
Assembly random_wall(double gap, Dice* dice) {
  constexpr double kLength = 4.0, kDepth = 0.5;
  std::vector<testing::BoxSpec> boxes{{.center = {2, 0, -0.5}, .size = {8, 3, 1}, .fixed = true}};
  const int courses = dice->integer(2, 7);
  double z = 0.0;
  for (int course = 0; course < courses; ++course) {
    const double height = dice->log_uniform(0.05, 0.6);
    std::vector<double> widths(dice->integer(1, 5));
    double sum = 0.0;
    for (double& width : widths) sum += width = dice->log_uniform(0.2, 1.0);
    double x = 0.0;
    for (const double width : widths) {
      const double length = width / sum * kLength;
      const Vec3 size(length - dice->uniform(0.0, gap), kDepth, height - dice->uniform(0.0, gap));
      boxes.push_back({.center = {x + 0.5 * length, 0, z + 0.5 * size.z()}, .size = size, .ring = course});
      x += length;
    }
    z += height;
  }
  return testing::make_boxes(boxes);
}

/// Boxes of random sizes on each other, shifted and turned about the vertical.
Assembly random_pile(double gap, Dice* dice) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {9, 9, 1}, .fixed = true}};
  const int count = dice->integer(3, 12);
  double z = 0.0;
  for (int k = 0; k < count; ++k) {
    const Vec3 size(dice->log_uniform(0.3, 2.0), dice->log_uniform(0.3, 2.0), dice->log_uniform(0.02, 1.0));
    const double turn = dice->uniform(0.0, M_PI), shift = dice->uniform(0.0, 0.1),
                 azimuth = dice->uniform(0.0, 6.28);
    z += dice->uniform(0.0, gap);
    boxes.push_back({.center = {shift * std::cos(azimuth), shift * std::sin(azimuth), z + 0.5 * size.z()},
                     .size = size,
                     .ring = k,
                     .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vec3::UnitZ()))});
    z += size.z();
  }
  return testing::make_boxes(boxes);
}

void add_random_loads(const Assembly& assembly, Dice* dice, Loads* loads) {
  const double weight = free_weight(assembly, testing::kG) / static_cast<double>(assembly.blocks.size());
  for (int k = dice->integer(0, 3); k > 0; --k) {
    BlockForce force;
    force.block = dice->integer(1, static_cast<int>(assembly.blocks.size()) - 1);
    force.force = weight * dice->log_uniform(0.01, 5.0) *
                  Vec3(dice->uniform(-0.3, 0.3), dice->uniform(-0.1, 0.1), dice->uniform(-1.0, 0.0));
    loads->forces.push_back(force);
  }
}

}  // namespace

Scene random_scene(std::uint64_t seed, FrictionLaw law) {
  constexpr int kLabels = 3;
  constexpr double kLargestGap = 1e-3;
  Dice dice(seed);
  Scene scene{statics(dice.chance(0.05) ? 0.0 : dice.log_uniform(0.1, 5.0), 1e-9, 1e-8), {}};
  const double gap = dice.chance(0.4) ? 0.0 : dice.log_uniform(1e-7, kLargestGap);
  scene.assembly = dice.chance(0.6) ? random_wall(gap, &dice) : random_pile(gap, &dice);
  std::vector<double> normal(kLabels), tangential(kLabels);
  for (int k = 0; k < kLabels; ++k) {
    normal[k] = dice.log_uniform(1e-13, 1e-6);
    tangential[k] = normal[k] * dice.log_uniform(0.1, 100.0);
  }
  set_compliances(normal, tangential, &scene.input);
  label_blocks([&](int) { return dice.integer(0, kLabels - 1); }, &scene.assembly);
  const double steepest = dice.chance(0.5) ? 0.05 : 0.3;
  scene.input.loads.gravity =
      testing::kG * Vec3(dice.uniform(-steepest, steepest), dice.uniform(-0.05, 0.05), -1.0);
  add_random_loads(scene.assembly, &dice, &scene.input.loads);
  scene.input.contact.margin = 4.0 * kLargestGap;
  scene.input.analysis.friction_law = law;
  return scene;
}

namespace {

/// The supports carry the loads to within the unbalanced forces of all blocks.
TrueError balances_as_a_whole(const Scene&, const Summary& summary, const Frame&) {
  TrueError error;
  const double missing = (summary.support_reaction_N + summary.applied_load_N).norm();
  if (stands(summary.status) && missing > summary.weight_N * summary.equilibrium_residual.value() +
                                              1e-13 * summary.applied_load_N.norm())
    error.refuted = fmt::format("reaction and loads differ by {:.2e} N", missing);
  return error;
}

}  // namespace

ExtremeScene random_row(std::uint64_t seed, FrictionLaw law) {
  const bool known = law == FrictionLaw::associated;
  return {"random",
          fmt::format("seed {}, {}", seed, name_of(law)),
          known ? "forces in extended precision" : "reaction equals loads",
          {Ending::stable, Ending::moving},
          [=] { return random_scene(seed, law); },
          known ? equals_exact_statics : balances_as_a_whole};
}

}  // namespace cupola
