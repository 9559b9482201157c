// Contacts on edges and corners.

#include <cmath>

#include <fmt/format.h>

#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

using testing::BoxSpec;

/// An equilibrium that any push ends must be reported as such.
std::string notes_unstable_balance(const Summary& summary, const Frame&) {
  return summary.message.find("unstable balance") != std::string::npos
             ? ""
             : "stable without the note that the balance is unstable";
}

/// Turns the body diagonal of a cube upright.
Eigen::Quaterniond on_corner() {
  return Eigen::Quaterniond::FromTwoVectors(Vec3::Ones(), Vec3::UnitZ());
}

/// Turns an edge along y to the bottom.
Eigen::Quaterniond on_edge() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitY()));
}

/// A fixed bar of 0.2 x 0.2 m along y, its upper edge at (x, z).
BoxSpec knife(double x, double z) {
  return {.center = {x, 0, z - 0.1 * std::sqrt(2.0)},
          .size = {0.2, 3, 0.2},
          .fixed = true,
          .rotation = on_edge()};
}

void add_balances(Rows* rows) {
  rows->push_back({"edges",
                   "cube balanced on its corner",
                   "stable, with the note `unstable balance`",
                   {Ending::stable},
                   [] {
                     return Scene{
                         statics(0.4, 1e-9),
                         testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                              {.center = {0, 0, std::sqrt(0.75)}, .rotation = on_corner()}})};
                   },
                   carries_weight_above,
                   notes_unstable_balance});
  rows->push_back(
      {"edges",
       "block balanced on a knife edge",
       "stable, with the note `unstable balance`",
       {Ending::stable},
       [] {
         return Scene{statics(0.4, 1e-9), testing::make_boxes({knife(0, 0), {.center = {0, 0, 0.5}}})};
       },
       carries_weight_above,
       notes_unstable_balance});
}

/// An equilibrium that a small push does not end.
std::string notes_nothing(const Summary& summary, const Frame& frame) {
  return notes_unstable_balance(summary, frame).empty() ? "called an unstable balance" : "";
}

/// Greenhill (1881): a column buckles under its own weight w per metre where h^3 > 7.8373 E I / w. Joints of
/// four corners at +-0.5 m, each of 1 / c, turn under a moment as E I = 1 / c N m2 per metre of height does.
void add_buckling_columns(Rows* rows) {
  constexpr double kCompliance = 1e-9;
  const double height = std::cbrt(7.8373 / kCompliance / (1000.0 * testing::kG));  // 92.8 m
  // Four cubes are more than the finite number of joints and their shear change.
  for (const int cubes : {static_cast<int>(height) - 4, static_cast<int>(height) + 4}) {
    const bool buckles = cubes > height;
    rows->push_back({"edges",
                     fmt::format("column of {} cubes, {:g} m/N", cubes, kCompliance),
                     fmt::format("{} the self-buckling height of {:.1f} m (Greenhill)",
                                 buckles ? "above" : "below", height),
                     {Ending::stable},
                     [cubes] {
                       return Scene{statics(0.4, kCompliance), pile(std::vector<Vec3>(cubes, Vec3::Ones()))};
                     },
                     carries_weight_above,
                     buckles ? notes_unstable_balance : notes_nothing});
  }
}

/// Reactions of the plank on knives at x = 0 and 3, with its centre of gravity at x = 1.
TrueError lever_rule(const Scene& scene, const Summary& summary, const Frame& frame) {
  const double weight = scene.assembly.blocks[2].mass * testing::kG;
  return compare(scene, summary, frame,
                 {between(frame, 0, 2, {0, 0, weight * 2 / 3}), between(frame, 1, 2, {0, 0, weight / 3})});
}

void add_supports(Rows* rows) {
  rows->push_back(
      {"edges",
       "plank on two knife edges",
       "2/3 and 1/3 of its weight; a safe balance",
       {Ending::stable},
       [] {
         return Scene{
             statics(0.0, 1e-9),
             testing::make_boxes({knife(0, 0), knife(3, 0), {.center = {1, 0, 0.05}, .size = {6, 1, 0.1}}})};
       },
       lever_rule,
       notes_nothing});
  rows->push_back({"edges",
                   "block on three corners of fixed cubes",
                   "forces in extended precision",
                   {Ending::stable},
                   [] {
                     std::vector<BoxSpec> boxes;
                     for (const Vec3& foot : {Vec3(1, 0, 0), Vec3(-0.6, 0.9, 0), Vec3(-0.5, -0.8, 0)})
                       boxes.push_back({.center = foot - Vec3(0, 0, std::sqrt(0.75)),
                                        .fixed = true,
                                        .rotation = on_corner()});
                     boxes.push_back({.center = {0, 0, 0.5}, .size = {4, 4, 1}});
                     return Scene{statics(0.4, 1e-9), testing::make_boxes(boxes)};
                   },
                   equals_exact_statics});
}

}  // namespace

void add_edge_rows(Rows* rows) {
  add_balances(rows);
  add_buckling_columns(rows);
  add_supports(rows);
}

}  // namespace cupola
