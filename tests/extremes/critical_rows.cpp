// Structures 0.1 % and 0.01 % from the limit, on both sides.

#include <cmath>

#include <fmt/format.h>

#include "tests/extremes/rows.hpp"
#include "tests/solver/keystone.hpp"

namespace cupola {
namespace {

constexpr double kDistances[] = {-1e-3, -1e-4, 1e-4, 1e-3};

std::string percent(double distance) {
  return fmt::format("{:+g} %", 100 * distance);
}

/// Least t/R of semicircular arches of 27 and 100 voussoirs that rotate (mu = 0.8), from the polygon of
/// admissible thrusts (friction_rows.cpp). Cocchetti and Rizzi (2020) give 0.107426 for a continuous arch.
constexpr double kThinnest27 = 0.106720904, kThinnest100 = 0.107455613;

void add_arches(Rows* rows) {
  const auto arch = [rows](int voussoirs, double limit, double distance, FrictionLaw law) {
    const bool stands = distance > 0;
    rows->push_back(
        {"near the limit",
         fmt::format("arch of {}, t/R {} from the limit, {}", voussoirs, percent(distance), name_of(law)),
         fmt::format("{}: least t/R {:.6f}", stands ? "stands" : "falls", limit),
         {stands ? Ending::stable : Ending::moving},
         [=] {
           Scene scene{statics(0.8, 1e-12),
                       testing::make_arch({.voussoirs = voussoirs, .thickness = limit * (1 + distance)})};
           scene.input.analysis.friction_law = law;
           return scene;
         },
         stands && voussoirs < 50 && law == FrictionLaw::associated ? equals_exact_statics
                                                                    : decltype(ExtremeScene::truth)()});
  };
  for (const double distance : kDistances) arch(27, kThinnest27, distance, FrictionLaw::associated);
  for (const double distance : {-1e-4, 1e-4}) arch(27, kThinnest27, distance, FrictionLaw::coulomb);
  for (const double distance : {-1e-4, 1e-4}) arch(100, kThinnest100, distance, FrictionLaw::associated);
}

/// Normal forces of the two sides of each bed of a tower of k cubes on a plane that leans by tan a: with the
/// weight w above a bed, whose centre of gravity is at the height H / 2, w cos a (1/2 -+ H tan a / 2) up to
/// H tan a = 1.
TrueError leaning_tower(const Scene& scene, const Summary& summary, const Frame& frame) {
  const int cubes = static_cast<int>(scene.assembly.blocks.size()) - 1;
  const Vec3 g = scene.input.loads.gravity;
  std::vector<KnownForce> known;
  for (int k = 0; k < cubes; ++k) {
    double height = 0.0, mass = 0.0;
    for (int j = k + 1; j <= cubes; ++j) {
      mass += scene.assembly.blocks[j].mass;
      height += std::cbrt(scene.assembly.blocks[j].volume);
    }
    for (const double side : {-1.0, 1.0}) {
      const double share = 0.5 - side * 0.5 * height * g.x() / g.z();
      known.push_back(between(frame, k, k + 1, Vec3(0, 0, -share * mass * g.z()),
                              [side](const Vec3& point) { return side * point.x() > 0; }));
      known.back().along = Vec3::UnitZ();
    }
  }
  return compare(scene, summary, frame, known);
}

void add_towers(Rows* rows) {
  for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb})
    for (const double distance : kDistances) {
      if (law == FrictionLaw::coulomb && std::abs(distance) > 1e-4) continue;
      rows->push_back(
          {"near the limit",
           fmt::format("tower of 10 cubes, lean {} from B/H, {}", percent(distance), name_of(law)),
           distance < 0 ? "stands; forces of the edges" : "overturns: tan a > B/H",
           {distance < 0 ? Ending::stable : Ending::moving},
           [=] {
             Scene scene{statics(0.8, 1e-9), pile(std::vector<Vec3>(10, Vec3::Ones()))};
             scene.input.loads.gravity = testing::tilted_gravity((1.0 + distance) / 10.0);
             scene.input.analysis.friction_law = law;
             return scene;
           },
           leaning_tower});
    }
}

/// Ferris and Tin-Loi (2001), wall 1: published limit 0.643, 0.64286 by linear programming.
void add_published_walls(Rows* rows) {
  for (const double distance : kDistances)
    for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
      const bool stands = distance < 0;
      if (law == FrictionLaw::coulomb && stands) continue;  // the limit of Coulomb's law is lower, not known
      rows->push_back({"near the limit",
                       fmt::format("wall of Ferris and Tin-Loi, load {} from the limit, {}",
                                   percent(distance), name_of(law)),
                       fmt::format("{}: limit 0.64286", stands ? "stands" : "moves"),
                       {stands ? Ending::stable : Ending::moving},
                       [=] {
                         Scene scene{statics(0.65, 1e-9), testing::ferris_wall(6, false)};
                         scene.input.loads.gravity = testing::tilted_gravity(0.642857 * (1.0 + distance));
                         scene.input.analysis.friction_law = law;
                         return scene;
                       },
                       stands ? equals_exact_statics : decltype(ExtremeScene::truth)()});
      rows->back().slow = law == FrictionLaw::coulomb;
    }
}

/// Ten bricks in harmonic overhang: brick k from the top is shifted by L / (2 k) over the next one, so that
/// each part above a bed balances on the edge below.
void add_overhang(Rows* rows) {
  for (const double distance : kDistances) {
    const bool stands = distance < 0;
    rows->push_back(
        {"near the limit",
         fmt::format("harmonic overhang of 10 bricks, {} from the limit", percent(distance)),
         stands ? "stands; weight above each bed" : "falls: beyond 1.464484 L",
         {stands ? Ending::stable : Ending::moving},
         [distance] {
           std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {2, 3, 1}, .fixed = true}};
           double x = 0.5;  // the centre of the lowest brick before its shift: half over the edge
           for (int k = 10; k >= 1; --k) {
             x += 0.5 / k * (1.0 + distance);
             boxes.push_back({.center = {x, 0, 0.1 + 0.2 * (10 - k)}, .size = {1, 0.5, 0.2}, .ring = 10 - k});
           }
           return Scene{statics(0.4, 1e-9), testing::make_boxes(boxes)};
         },
         carries_weight_above});
  }
}

/// Keystones and leaning cards near the friction from which forces that carry them exist. Under Coulomb's law
/// a keystone on compliant joints falls at any friction, because its joints open as it sinks.
void add_frictions(Rows* rows) {
  constexpr double kNear[] = {-1e-2, -1e-3, -1e-4, 1e-4, 1e-3, 1e-2};
  const auto add = [&](const std::string& what, double critical, double distance, FrictionLaw law,
                       const Assembly& assembly) {
    const bool stands = distance > 0.0;
    rows->push_back({"near the limit",
                     fmt::format("{}, friction {} from the limit, {}", what, percent(distance), name_of(law)),
                     fmt::format("{}: least friction {:.6g}", stands ? "stands" : "falls", critical),
                     {stands ? Ending::stable : Ending::moving},
                     [=] {
                       Scene scene{statics(critical * (1.0 + distance), 1e-9), assembly};
                       scene.input.analysis.friction_law = law;
                       return scene;
                     }});
  };
  for (const double slope : {0.1, 0.5})
    for (const double distance : kNear)
      for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
        if (law == FrictionLaw::coulomb && distance > 0.0) continue;
        add(fmt::format("keystone, slope {:g}", slope), slope, distance, law, testing::keystone(slope));
      }
  for (const double lean : {0.25, 0.75}) {
    const testing::LeaningCards cards{.lean = lean};
    for (const double distance : kNear)
      for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb})
        add(fmt::format("two cards leaning at {:g} rad", lean), cards.critical_friction(), distance, law,
            cards.assembly());
  }
}

}  // namespace

void add_critical_rows(Rows* rows) {
  add_arches(rows);
  add_towers(rows);
  add_published_walls(rows);
  add_overhang(rows);
  add_frictions(rows);
}

}  // namespace cupola
