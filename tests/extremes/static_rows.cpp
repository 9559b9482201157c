// Rows that compute a static equilibrium.

#include <cmath>

#include <fmt/format.h>

#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "tests/extremes/rows.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola {
namespace {

using testing::BoxSpec;

/// A static case with the given friction and compliance (m/N per point); `tolerance` is relative to the mean
/// block weight.
Case statics(double mu, double compliance, double tolerance = 1e-9) {
  Case input;
  input.joints.friction = mu;
  input.joints.compliance = {compliance, compliance, Compliance::Per::point};
  input.analysis.tolerance = tolerance;
  return input;
}

/// Checks that the supports carry the weight to within the requested accuracy.
std::string carries_weight(const Summary& s, const Frame&) {
  const double missing = std::abs(s.support_reaction_N.z() - s.weight_N);
  const double allowed = s.accuracy.asked * s.weight_N;
  if (missing <= allowed) return "";
  return fmt::format("reaction differs from the weight by {:.2e} N, {:.2e} N allowed", missing, allowed);
}

Assembly small_wall(double size = 1.0) {
  return testing::transformed(testing::running_bond_wall({1.0, 0.5, 0.5}, 4, 6),
                              Eigen::Isometry3d::Identity(), size);
}

Assembly semicircle(int voussoirs, double thickness) {
  return testing::make_arch({.voussoirs = voussoirs, .thickness = thickness});
}

void add_compliances(std::vector<ExtremeScene>* rows) {
  for (const double c : {0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    rows->push_back({"compliance",
                     fmt::format("wall, {:g} m/N", c),
                     "stable, carries its weight",
                     {Ending::stable},
                     [c] {
                       return Scene{statics(0.4, c), small_wall()};
                     },
                     carries_weight});
    rows->push_back({"compliance",
                     fmt::format("arch, {:g} m/N", c),
                     "stable, carries its weight",
                     {Ending::stable},
                     [c] {
                       return Scene{statics(0.6, c), semicircle(27, 0.15)};
                     },
                     carries_weight});
  }
}

void add_softness(std::vector<ExtremeScene>* rows) {
  rows->push_back({"compliance",
                   "wall, 1 m/N: would sink by kilometres",
                   "stable in the undeformed geometry, with a warning",
                   {Ending::stable},
                   [] {
                     return Scene{statics(0.4, 1.0), small_wall()};
                   },
                   [](const Summary& s, const Frame&) {
                     return s.message.find("not small compared with the smallest") != std::string::npos
                                ? std::string()
                                : fmt::format("sinks by {:.2g} m without a warning",
                                              s.max_displacement_m.value());
                   }});
}

void add_frictions(std::vector<ExtremeScene>* rows) {
  for (const double mu : {0.0, 1e-6, 1.0, 10.0}) {
    rows->push_back({"friction",
                     fmt::format("wall, mu {:g}", mu),
                     "stable: the beds are level",
                     {Ending::stable},
                     [mu] {
                       return Scene{statics(mu, 1e-9), small_wall()};
                     },
                     carries_weight});
    const bool stands = mu >= 0.4;
    rows->push_back({"friction",
                     fmt::format("arch, mu {:g}", mu),
                     stands ? "stable" : "moving: slides at the haunches",
                     {stands ? Ending::stable : Ending::moving},
                     [mu] {
                       return Scene{statics(mu, 1e-9), semicircle(27, 0.15)};
                     }});
  }
}

/// With a compliance proportional to size^-2 the displacement over the size is the same at every size.
void add_sizes(std::vector<ExtremeScene>* rows) {
  for (const double size : {1e-3, 1.0, 1e3})
    rows->push_back({"size",
                     fmt::format("wall, blocks of {:g} m", size),
                     "stable, carries its weight",
                     {Ending::stable},
                     [size] {
                       return Scene{statics(0.4, 1e-9 / (size * size)), small_wall(size)};
                     },
                     carries_weight});
  rows->push_back(
      {"size",
       "cubes of 1 mm to 1 km in one stack",
       "stable or not reached: masses span 1e18",
       {Ending::stable, Ending::missed},
       [] {
         std::vector<BoxSpec> boxes{{.center = {0, 0, -500}, .size = {3e3, 3e3, 1e3}, .fixed = true}};
         double height = 0.0;
         for (double side = 1e3; side > 0.5e-3; side /= 10.0) {
           boxes.push_back({.center = {0, 0, height + side / 2}, .size = {side, side, side}});
           height += side;
         }
         return Scene{statics(0.4, 1e-16), testing::make_boxes(boxes)};
       },
       carries_weight});
}

void add_masses(std::vector<ExtremeScene>* rows) {
  for (const double density : {1.0, 1e5})
    rows->push_back(
        {"density",
         fmt::format("stack of 10, {:g} kg/m3", density),
         "stable, carries its weight",
         {Ending::stable},
         [density] {
           return Scene{statics(0.4, 1e-9), testing::stack_of_cubes(1.0, std::vector<double>(10, density))};
         },
         carries_weight});
  for (const double ratio : {1e2, 1e4, 1e6})
    rows->push_back(
        {"mass ratio",
         fmt::format("heavy on light, ratio {:g}, twice", ratio),
         "stable, carries its weight",
         {Ending::stable},
         [ratio] {
           return Scene{statics(0.4, 1e-12), testing::stack_of_cubes(1.0, {1.0, ratio, 1.0, ratio})};
         },
         carries_weight});
}

void add_many_blocks(std::vector<ExtremeScene>* rows) {
  for (const double c : {0.0, 1e-14, 1e-8})
    rows->push_back(
        {"stack",
         fmt::format("100 cubes, {:g} m/N", c),
         "stable, carries its weight",
         {Ending::stable},
         [c] {
           return Scene{statics(0.4, c), testing::stack_of_cubes(1.0, std::vector<double>(100, 2000.0))};
         },
         carries_weight});
  rows->push_back(
      {"wall",
       "5,050 blocks, 1e-12 m/N",
       "stable, carries its weight",
       {Ending::stable},
       [] {
         return Scene{statics(0.4, 1e-12, 1e-8), testing::running_bond_wall({0.24, 1.0, 0.06}, 50, 100)};
       },
       carries_weight,
       true});
}

/// Semicircular arches of 100 polygonal voussoirs near their minimum thickness, t/R = 0.10746 by independent
/// linear programs.
void add_thin_arches(std::vector<ExtremeScene>* rows) {
  constexpr double kLimit = 0.10746;
  for (const double share : {0.99, 0.999, 1.001, 1.01}) {
    const bool stands = share > 1.0;
    rows->push_back({"thin arch",
                     fmt::format("100 voussoirs, {:g} of the critical thickness", share),
                     stands ? "stable" : "moving",
                     {stands ? Ending::stable : Ending::moving},
                     [share] {
                       return Scene{statics(0.8, 1e-14), semicircle(100, share * kLimit)};
                     }});
  }
}

/// Methods that run out of iterations must report it and not call the structure moving.
void add_budgets(std::vector<ExtremeScene>* rows) {
  for (const auto method : {ContactMethod::newton, ContactMethod::spg, ContactMethod::apgd,
                            ContactMethod::nsgs, ContactMethod::admm})
    rows->push_back({"budget",
                     fmt::format("arch of 100 voussoirs, {}, 3 iterations", to_string(method)),
                     "stable or not reached",
                     {Ending::stable, Ending::missed},
                     [method] {
                       Scene scene{statics(0.8, 1e-9), semicircle(100, 0.15)};
                       scene.input.analysis.method = method;
                       scene.input.analysis.max_iterations = 3;
                       return scene;
                     }});
}

void add_slivers(std::vector<ExtremeScene>* rows) {
  rows->push_back({"sliver",
                   "five plates of 1 x 1 m, 0.1 mm thick, on a floor",
                   "stable, carries its weight",
                   {Ending::stable},
                   [] {
                     std::vector<BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}};
                     for (int k = 0; k < 5; ++k)
                       boxes.push_back({.center = {0, 0, (k + 0.5) * 1e-4}, .size = {1, 1, 1e-4}, .ring = k});
                     return Scene{statics(0.4, 1e-9), testing::make_boxes(boxes)};
                   },
                   carries_weight});
  rows->push_back({"sliver",
                   "a needle 1 m long, 0.1 mm thick, lying on a floor",
                   "stable, carries its weight",
                   {Ending::stable},
                   [] {
                     return Scene{
                         statics(0.4, 1e-9),
                         testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                              {.center = {0, 0, 0.5e-4}, .size = {1, 1e-4, 1e-4}}})};
                   },
                   carries_weight});
}

void add_places(std::vector<ExtremeScene>* rows) {
  for (const double far : {1e3, 1e6})
    rows->push_back({"far away",
                     fmt::format("wall {:g} m from the origin", far),
                     "stable, carries its weight",
                     {Ending::stable},
                     [far] {
                       Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
                       motion.translation() = Vec3(far, -far, far);
                       return Scene{statics(0.4, 1e-9), testing::transformed(small_wall(), motion)};
                     },
                     carries_weight});
}

/// A stack of cubes with the given gaps below each; a negative gap is an overlap.
Assembly spaced_stack(const std::vector<double>& gaps) {
  std::vector<BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}};
  double height = 0.0;
  for (size_t k = 0; k < gaps.size(); ++k) {
    height += gaps[k];
    boxes.push_back({.center = {0, 0, height + 0.5}, .size = {1, 1, 1}, .ring = static_cast<int>(k)});
    height += 1.0;
  }
  return testing::make_boxes(boxes);
}

void add_gaps(std::vector<ExtremeScene>* rows) {
  const auto stack = [rows](const char* name, const char* expected, std::vector<Ending> endings,
                            std::vector<double> gaps, double c) {
    rows->push_back({"gaps", name, expected, std::move(endings), [gaps, c] {
                       return Scene{statics(0.4, c), spaced_stack(gaps)};
                     }});
  };
  stack("stack, joints open by 0.01 to 3 mm", "stable: the joints close", {Ending::stable},
        {1e-3, 1e-5, 3e-3, 5e-4, 2e-3}, 1e-9);
  stack("the same, 1e-13 m/N", "stable or not reached", {Ending::stable, Ending::missed},
        {1e-3, 1e-5, 3e-3, 5e-4, 2e-3}, 1e-13);
  rows->push_back({"gaps", "wall, joints randomly open by up to 1 mm", "stable", {Ending::stable}, [] {
                     const Case input = read_case(CUPOLA_SOURCE_DIR "/cases/wall_medium.yaml",
                                                  {"imperfections.gap=1e-3", "imperfections.seed=7"});
                     return Scene{input, generate(input)};
                   }});
  stack("stack, blocks overlap by 0.1 mm", "stable", {Ending::stable}, {-1e-4, -1e-4, -1e-4}, 1e-9);
  stack("a block half inside another", "refused: overlap beyond the margin", {Ending::refused}, {0.0, -0.5},
        1e-9);
}

void add_supports(std::vector<ExtremeScene>* rows) {
  rows->push_back({"support", "a block in the air", "moving", {Ending::moving}, [] {
                     return Scene{statics(0.4, 1e-9), spaced_stack({0.0, 5.0})};
                   }});
  rows->push_back({"support", "one free block alone", "moving", {Ending::moving}, [] {
                     return Scene{statics(0.4, 1e-9), testing::make_boxes({BoxSpec{}})};
                   }});
  rows->push_back({"support", "one fixed block alone", "stable: nothing can move", {Ending::stable}, [] {
                     return Scene{statics(0.4, 1e-9), testing::make_boxes({BoxSpec{.fixed = true}})};
                   }});
  rows->push_back(
      {"support", "two free blocks that do not touch", "moving", {Ending::moving}, [] {
         return Scene{statics(0.4, 1e-9), testing::make_boxes({BoxSpec{}, BoxSpec{.center = {9, 0, 0}}})};
       }});
  rows->push_back({"support", "a wall without gravity", "stable, no forces", {Ending::stable}, [] {
                     Scene scene{statics(0.4, 1e-9), small_wall()};
                     scene.input.loads.gravity.setZero();
                     return scene;
                   }});
}

void add_wedges(std::vector<ExtremeScene>* rows) {
  for (const double c : {0.0, 1e-9})
    rows->push_back({"wedge",
                     fmt::format("between walls leaning outward by 30 degrees, {:g} m/N", c),
                     "stable: wedged in",
                     {Ending::stable},
                     [c] {
                       return Scene{statics(0.4, c), wedge(30.0)};
                     }});
  rows->push_back({"wedge",
                   "between upright walls, associated law",
                   "stable: jammed by the dilation of the law",
                   {Ending::stable},
                   [] {
                     return Scene{statics(0.8, 1e-9), wedge(0.0)};
                   }});
  rows->push_back({"wedge",
                   "between upright walls, Coulomb's law",
                   "moving: nothing presses it against the walls",
                   {Ending::moving},
                   [] {
                     Scene scene{statics(0.8, 1e-9), wedge(0.0)};
                     scene.input.analysis.friction_law = FrictionLaw::coulomb;
                     return scene;
                   }});
}

}  // namespace

void add_static_rows(std::vector<ExtremeScene>* rows) {
  add_compliances(rows);
  add_softness(rows);
  add_frictions(rows);
  add_sizes(rows);
  add_masses(rows);
  add_many_blocks(rows);
  add_thin_arches(rows);
  add_budgets(rows);
  add_slivers(rows);
  add_places(rows);
  add_gaps(rows);
  add_supports(rows);
  add_wedges(rows);
}

}  // namespace cupola
