// Slender bricks and high towers.

#include <cmath>

#include <fmt/format.h>

#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

void add_slender_bricks(Rows* rows) {
  rows->push_back({"slender",
                   "wall of bricks 1:200 (1 m x 5 mm), 40 courses of 6",
                   "weight above each course",
                   {Ending::stable},
                   [] {
                     return Scene{statics(0.4, 1e-10), testing::running_bond_wall({1.0, 0.1, 0.005}, 6, 40)};
                   },
                   carries_weight_above});
  rows->push_back({"slender",
                   "the same, beds open at random by up to 1 um",
                   "forces in extended precision",
                   {Ending::stable},
                   [] {
                     Scene scene{statics(0.4, 1e-10), testing::running_bond_wall({1.0, 0.1, 0.005}, 3, 12)};
                     // Raises vertices of the free blocks by multiples of 1 um / 7 that follow no pattern.
                     for (size_t i = 8; i < scene.assembly.vertices.size(); ++i)
                       scene.assembly.vertices[i].z() -= 1e-6 / 7 * static_cast<double>(i / 8 * 5 % 7);
                     compute_mass_properties(&scene.assembly);
                     scene.input.contact.margin = 1e-4;
                     return scene;
                   },
                   equals_exact_statics});
  rows->push_back({"slender",
                   "five plates 1:10,000 (1 m x 0.1 mm)",
                   "weight above each plate",
                   {Ending::stable},
                   [] {
                     return Scene{statics(0.4, 1e-9), pile(std::vector<Vec3>(5, Vec3(1, 1, 1e-4)))};
                   },
                   carries_weight_above});
  for (const double distance : {-1e-3, 1e-3})
    rows->push_back({"slender",
                     fmt::format("needle 1:200 on its end, lean {:+g} % from overturning", 100 * distance),
                     distance < 0 ? "stands; its weight" : "overturns: tan a > 1/200",
                     {distance < 0 ? Ending::stable : Ending::moving},
                     [distance] {
                       Scene scene{statics(0.4, 1e-9), pile({Vec3(0.01, 0.01, 2.0)})};
                       scene.input.loads.gravity = testing::tilted_gravity((1.0 + distance) / 200.0);
                       return scene;
                     },
                     carries_weight_above});
}

void add_tower(const std::string& name, Case input, Rows* rows) {
  rows->push_back({"tower of 500",
                   name,
                   "weight above each block",
                   {Ending::stable},
                   [input] {
                     return Scene{input, pile(std::vector<Vec3>(500, Vec3::Ones()))};
                   },
                   carries_weight_above});
}

void add_slender_towers(Rows* rows) {
  add_tower("1e-9 m/N, draft", statics(0.4, 1e-9, kDraft), rows);
  add_tower("1e-9 m/N, standard", statics(0.4, 1e-9, kStandard), rows);
  add_tower("1e-9 m/N", statics(0.4, 1e-9), rows);
  add_tower("rigid", statics(0.4, 0.0), rows);
  add_tower("1e-9 m/N, Coulomb's law", coulomb(statics(0.4, 1e-9)), rows);
  Case leaning = statics(0.4, 1e-9);
  leaning.loads.gravity = testing::tilted_gravity(0.9 / 500.0);  // lifts one edge of the lower beds
  add_tower("leaning by 90 % of overturning", leaning, rows);
}

void add_heavy_on_light(Rows* rows) {
  rows->push_back({"tower of 500",
                   "heavy on light by 1e6, 20 times in turn (40 cubes)",
                   "weight above each block",
                   {Ending::stable},
                   [] {
                     std::vector<double> densities;
                     for (int k = 0; k < 20; ++k) densities.insert(densities.end(), {1.0, 1e6});
                     return Scene{statics(0.4, 1e-12), testing::stack_of_cubes(1.0, densities)};
                   },
                   carries_weight_above});
}

}  // namespace

void add_shape_rows(Rows* rows) {
  add_slender_bricks(rows);
  add_slender_towers(rows);
  add_heavy_on_light(rows);
}

}  // namespace cupola
