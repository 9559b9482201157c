// Towers whose stability is known: loads are vertical and beds horizontal, so that a tower stands, under any
// flow rule and friction, exactly if the weight above each bed acts inside it.

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "tests/extremes/dice.hpp"
#include "tests/extremes/random_scene.hpp"
#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

/// A box of a tower: centre of its plan and size, m.
struct TowerBox {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Vec3 size = Vec3::Ones();
};

/// The smallest distance of the weight above a bed from the sides of the bed, over half its width; negative if
/// it is outside. None if two boxes do not touch.
std::optional<double> margin_of(const std::vector<TowerBox>& boxes) {
  double margin = 1.0, weight = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (auto k = static_cast<int>(boxes.size()) - 1; k >= 0; --k) {
    const TowerBox &box = boxes[k], &below = boxes[std::max(k - 1, 0)];
    weight += box.size.prod();
    moment += box.size.prod() * box.centre;
    for (int axis = 0; axis < 2; ++axis) {
      const double low =
          std::max(box.centre[axis] - 0.5 * box.size[axis], below.centre[axis] - 0.5 * below.size[axis]);
      const double high =
          std::min(box.centre[axis] + 0.5 * box.size[axis], below.centre[axis] + 0.5 * below.size[axis]);
      if (!(high - low > 0.1 * box.size[axis])) return std::nullopt;
      const double at = moment[axis] / weight;
      margin = std::min(margin, std::min(at - low, high - at) / (0.5 * (high - low)));
    }
  }
  return margin;
}

struct Tower {
  std::vector<TowerBox> boxes;
  bool stands = true;
};

Tower random_tower(Dice* dice) {
  constexpr double kClear = 0.02;  // margin; nearer to the edge rounding and tolerance may decide
  Tower tower{std::vector<TowerBox>(static_cast<size_t>(dice->log_uniform(3.0, 300.0))), true};
  std::vector<Eigen::Vector2d> shift;
  for (TowerBox& box : tower.boxes) {
    box.size = {dice->log_uniform(0.5, 2.0), dice->log_uniform(0.5, 2.0), dice->log_uniform(0.1, 1.0)};
    shift.emplace_back(dice->uniform(-1.0, 1.0), dice->uniform(-1.0, 1.0));
  }
  const Eigen::Vector2d drift(dice->uniform(-0.3, 0.3), dice->uniform(-0.3, 0.3));
  for (double amplitude = dice->chance(0.3) ? 0.0 : dice->log_uniform(1e-4, 0.5);; amplitude *= 0.9) {
    for (size_t k = 1; k < tower.boxes.size(); ++k)
      tower.boxes[k].centre = tower.boxes[k - 1].centre + amplitude * (shift[k] + drift);
    const std::optional<double> margin = margin_of(tower.boxes);
    if (!margin || std::abs(*margin) < kClear) continue;
    tower.stands = *margin > 0.0;
    return tower;
  }
}

Assembly assembly_of(const Tower& tower) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {9, 9, 1}, .fixed = true}};
  double z = 0.0;
  for (const TowerBox& box : tower.boxes) {
    boxes.push_back({.center = {box.centre.x(), box.centre.y(), z + 0.5 * box.size.z()},
                     .size = box.size,
                     .ring = static_cast<int>(boxes.size())});
    z += box.size.z();
  }
  return testing::make_boxes(boxes);
}

Scene tower_scene(std::uint64_t seed, FrictionLaw law) {
  constexpr int kLabels = 3;
  Dice dice(seed);
  Scene scene{statics(dice.log_uniform(0.05, 2.0), 1e-9, 1e-8), assembly_of(random_tower(&dice))};
  const bool all_rigid = dice.chance(0.2);
  std::vector<double> normal(kLabels), tangential(kLabels);
  for (int k = 0; k < kLabels; ++k) {
    normal[k] = all_rigid || dice.chance(0.2) ? 0.0 : dice.log_uniform(1e-15, 1e-7);
    tangential[k] = normal[k] * dice.log_uniform(0.1, 100.0);
  }
  set_compliances(normal, tangential, &scene.input);
  label_blocks([&](int) { return dice.integer(0, kLabels - 1); }, &scene.assembly);
  scene.input.analysis.friction_law = law;
  return scene;
}

}  // namespace

ExtremeScene random_tower_row(std::uint64_t seed, FrictionLaw law) {
  Dice dice(seed);
  dice.log_uniform(0.05, 2.0);
  const bool stands = random_tower(&dice).stands;
  return {"random",
          fmt::format("tower {}, {}", seed, name_of(law)),
          stands ? "all weight acts inside the beds" : "weight acts outside a bed",
          {stands ? Ending::stable : Ending::moving},
          [=] { return tower_scene(seed, law); }};
}

}  // namespace cupola
