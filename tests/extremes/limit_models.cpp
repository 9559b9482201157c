#include "tests/extremes/limit_models.hpp"

#include <fmt/format.h>

#include "generators/generate.hpp"
#include "tests/extremes/dice.hpp"
#include "tests/extremes/rows.hpp"
#include "tests/solver/keystone.hpp"

namespace cupola {
namespace {

using Parameter = LimitSearch::Parameter;

Case limit_case(Parameter parameter, double low, double high, double friction) {
  Case scene = statics(friction, 1e-9);
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = parameter;
  scene.analysis.limit.low = low;
  scene.analysis.limit.high = high;
  return scene;
}

LimitModel pushed(std::string name, Assembly assembly, double friction, Dice* dice) {
  LimitModel model{std::move(name),
                   {limit_case(Parameter::acceleration, 0.0, 3.0, friction), std::move(assembly)}};
  const double azimuth = dice->chance(0.5) ? 0.0 : dice->uniform(0.0, 6.28);
  model.scene.input.analysis.limit.direction = {std::cos(azimuth), std::sin(azimuth), 0.0};
  return model;
}

/// Running bond of random courses.
LimitModel wall(Dice* dice) {
  std::vector<testing::BoxSpec> boxes{{.center = {2, 0, -0.5}, .size = {8, 3, 1}, .fixed = true}};
  const int courses = dice->integer(2, 6), blocks = dice->integer(1, 4);
  const double length = 4.0 / blocks, depth = dice->uniform(0.2, 0.6);
  double z = 0.0;
  for (int course = 0; course < courses; ++course) {
    const double height = dice->uniform(0.15, 0.4), shift = course % 2 == 0 ? 0.0 : 0.5 * length;
    for (int k = 0; k <= blocks; ++k) {
      const double low = std::max(0.0, k * length - shift), high = std::min(4.0, (k + 1) * length - shift);
      if (high - low < 1e-6) continue;
      boxes.push_back({.center = {0.5 * (low + high), 0, z + 0.5 * height},
                       .size = {high - low, depth, height},
                       .ring = course});
    }
    z += height;
  }
  return pushed("wall", testing::make_boxes(boxes), dice->uniform(0.3, 0.8), dice);
}

LimitModel tower(Dice* dice) {
  const int cubes = dice->integer(2, 50);
  LimitModel model =
      pushed("tower", pile(std::vector<Vec3>(cubes, Vec3::Ones())), dice->uniform(0.6, 1.0), dice);
  model.scene.input.analysis.limit.direction = {1, 0, 0};
  return model;
}

LimitModel arch(Dice* dice) {
  return pushed(
      "arch", testing::make_arch({.voussoirs = dice->integer(5, 25), .thickness = dice->uniform(0.13, 0.3)}),
      dice->uniform(0.5, 0.9), dice);
}

/// Stands from the slope of the walls on.
LimitModel wedge(Dice* dice) {
  LimitModel model{
      "wedge",
      {limit_case(Parameter::friction, 0.0, 3.0, 0.5), testing::keystone(dice->uniform(0.05, 0.6))},
      true};
  return model;
}

LimitModel cards(Dice* dice) {
  testing::LeaningCards cards{.lean = dice->uniform(0.2, 0.7)};
  cards.width = dice->uniform(0.02, 0.1);
  return {"cards", {limit_case(Parameter::friction, 0.01, 3.0, 0.5), cards.assembly()}, true};
}

LimitModel dome(Dice* dice) {
  Case scene = limit_case(Parameter::acceleration, 0.0, 3.0, dice->uniform(0.3, 0.7));
  scene.geometry.surface = DomeSurface{dice->uniform(4.0, 12.0), dice->uniform(0.5, 0.8),
                                       dice->uniform(0.5, 1.0), dice->uniform(50.0, 70.0)};
  scene.geometry.bond = RunningBond{dice->integer(2, 5), dice->integer(6, 10), 2};
  Assembly assembly = generate(scene);
  return {"dome", {scene, std::move(assembly)}};
}

/// The portal of cases/portal.obj.
LimitModel imported(Dice* dice) {
  Case scene = limit_case(Parameter::acceleration, 0.0, 3.0, dice->uniform(0.1, 0.9));
  ImportedBlocks portal;
  portal.path = CUPOLA_SOURCE_DIR "/cases/portal.obj";
  portal.metres_per_unit = dice->log_uniform(0.1, 10.0);
  portal.supports = {"ground"};
  scene.geometry.imported = portal;
  const double azimuth = dice->uniform(0.0, 6.28);
  scene.analysis.limit.direction = {std::cos(azimuth), std::sin(azimuth), 0.0};
  Assembly assembly = generate(scene);
  return {"import", {scene, std::move(assembly)}};
}

}  // namespace

LimitModel limit_model(std::uint64_t seed) {
  Dice dice(seed);
  const std::array makers{wall, tower, arch, wedge, cards, dome, imported};
  LimitModel model = makers[seed % makers.size()](&dice);
  model.name += fmt::format(" {}", seed);
  return model;
}

}  // namespace cupola
