// Stiff and soft joints side by side.

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

using testing::BoxSpec;

constexpr const char* kExact = "forces in extended precision (exact_statics.hpp)";
constexpr int kCourses = 5;
constexpr double kCubeWeight = 1000.0 * testing::kG;

/// Three columns of five cubes under one beam of the weight of 90 cubes. (Under one of less than ten, the
/// soft columns shorten so much by their own weight that the beam lifts off.) The outer joints have label 0
/// and the middle ones label 1, between cubes and under the beam, but not on the floor.
Assembly three_columns() {
  std::vector<BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {12, 3, 1}, .fixed = true}};
  for (const double x : {-4.0, 0.0, 4.0})
    for (int k = 0; k < kCourses; ++k) boxes.push_back({.center = {x, 0, k + 0.5}, .ring = k});
  boxes.push_back(
      {.center = {0, 0, kCourses + 0.5}, .size = {9, 1, 1}, .density = 10.0 * 1000.0, .ring = kCourses});
  Assembly assembly = testing::make_boxes(boxes);
  label_blocks([](int block) { return block > kCourses + 1 && block <= 2 * kCourses ? 1 : 0; }, &assembly);
  return assembly;
}

/// Forces under the beam. Every joint has four points, so that a column with the top load F shortens by
///
///     sum over its beds of c / 4 (F + weight above in the column)
///
/// The beam stays level by symmetry: the three columns shorten equally. Beds on the floor have the outer
/// compliance c_0; those inside the middle column and under its beam c_1.
TrueError shared_beam(const Scene& scene, const Summary& summary, const Frame& frame) {
  const auto c = [&](int label) { return *scene.input.joints.rings[label].law.normal; };
  const auto column = [&](double inner) {  // shortening = offset + slope F
    double offset = c(0) * kCourses * kCubeWeight, slope = c(0) + kCourses * inner;
    for (int above = 1; above < kCourses; ++above) offset += inner * above * kCubeWeight;
    return std::pair(offset, slope);
  };
  const auto [offset_0, slope_0] = column(c(0));
  const auto [offset_1, slope_1] = column(c(1));
  const double beam =
      90.0 * kCubeWeight;  // 2 F_0 + F_1 = beam, offset_0 + slope_0 F_0 = offset_1 + slope_1 F_1
  const double F_0 = (offset_1 - offset_0 + slope_1 * beam) / (slope_0 + 2.0 * slope_1);
  const double F_1 = beam - 2.0 * F_0;
  const int top = 3 * kCourses + 1;
  return compare(scene, summary, frame,
                 {between(frame, kCourses, top, {0, 0, F_0}), between(frame, 2 * kCourses, top, {0, 0, F_1}),
                  between(frame, 3 * kCourses, top, {0, 0, F_0})});
}

void add_columns(Rows* rows) {
  for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb})
    for (const double soft : {1e-5, 1e-6})
      rows->push_back(
          {"compliance contrast",
           fmt::format("beam on columns of {:g}, {:g} and {:g} m/N, {}", soft, 1e-13, soft, name_of(law)),
           "shares of the columns: closed form",
           {Ending::stable},
           [law, soft] {
             Scene scene{statics(0.4, soft), three_columns()};
             scene.input.analysis.friction_law = law;
             set_compliances({soft, 1e-13}, {soft, 1e-13}, &scene.input);
             return scene;
           },
           shared_beam});
}

/// Wall of 36 blocks in eight courses of four or five.
Assembly wall_of_36() {
  return testing::running_bond_wall({1.0, 0.5, 0.5}, 4, 8);
}

/// Every second block has label 1.
Assembly mixed_wall() {
  Assembly wall = wall_of_36();
  label_blocks([](int block) { return block % 2; }, &wall);
  return wall;
}

void add_walls(Rows* rows) {
  struct Wall {
    const char* name;
    double soft, stiff, tolerance;
  };
  for (const auto& w : {Wall{"1e-6 and 1e-13 m/N side by side", 1e-6, 1e-13, 1e-9},
                        Wall{"the same, standard", 1e-6, 1e-13, kStandard},
                        Wall{"the same, tolerance 1e-7", 1e-6, 1e-13, 1e-7},
                        Wall{"1e-6 and 1e-14 m/N side by side", 1e-6, 1e-14, 1e-9}})
    rows->push_back({"compliance contrast",
                     fmt::format("wall of 36 blocks, {}", w.name),
                     kExact,
                     {Ending::stable},
                     [w] {
                       Scene scene{statics(0.4, w.soft, w.tolerance), mixed_wall()};
                       set_compliances({w.soft, w.stiff}, {w.soft, w.stiff}, &scene.input);
                       return scene;
                     },
                     equals_exact_statics});
  rows->push_back({"compliance contrast",
                   "wall of 36 blocks, rigid joints among joints of 1e-6 m/N",
                   "weight above each course",
                   {Ending::stable},
                   [] {
                     Scene scene{statics(0.4, 1e-6), mixed_wall()};
                     set_compliances({1e-6, 0.0}, {1e-6, 0.0}, &scene.input);
                     return scene;
                   },
                   carries_weight_above});
}

/// Horizontal gravity of 0.2 g brings the tangential springs and friction into play.
void add_directions(Rows* rows) {
  for (const auto& [normal, tangential] : {std::pair(1e-14, 1e-6), std::pair(1e-6, 1e-14)})
    rows->push_back(
        {"compliance contrast",
         fmt::format("wall pushed by 0.2 g, {:g} m/N normal, {:g} tangential", normal, tangential),
         kExact,
         {Ending::stable},
         [normal = normal, tangential = tangential] {
           Scene scene{statics(0.4, normal), wall_of_36()};
           scene.input.joints.compliance.tangential = tangential;
           scene.input.loads.gravity.x() = 0.2 * testing::kG;
           return scene;
         },
         equals_exact_statics});
}

void add_arch(Rows* rows) {
  rows->push_back({"compliance contrast",
                   "arch of 27, joints of 1e-6 and 1e-14 m/N in turn",
                   kExact,
                   {Ending::stable},
                   [] {
                     Scene scene{statics(0.8, 1e-6), testing::make_arch({})};
                     label_blocks([](int block) { return block % 3 == 0; }, &scene.assembly);
                     set_compliances({1e-6, 1e-14}, {1e-6, 1e-14}, &scene.input);
                     return scene;
                   },
                   equals_exact_statics});
}

}  // namespace

void add_contrast_rows(Rows* rows) {
  add_columns(rows);
  add_walls(rows);
  add_directions(rows);
  add_arch(rows);
}

}  // namespace cupola
