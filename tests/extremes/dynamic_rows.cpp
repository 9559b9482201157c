// Rows with motion in time and rows that must be refused.

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "tests/extremes/rows.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola {
namespace {

using testing::BoxSpec;

/// A dynamic case of `steps` steps of h, from equilibrium or from the unloaded assembly, to a momentum
/// residual of 1e-8.
Case motion(double mu, double compliance, double h, int steps, Analysis::Start start) {
  Case input = testing::make_case(mu, compliance, h);
  input.analysis.tolerance = 1e-8;
  input.analysis.duration = h * steps;
  input.analysis.start = start;
  input.output.frames_every = input.analysis.duration;
  return input;
}

/// Checks that no penetration exceeds `depth` (m) at the end.
auto sinks_less_than(double depth) {
  return [depth](const Summary& s, const Frame&) {
    return s.max_penetration_m <= depth
               ? std::string()
               : fmt::format("penetration of {:.2e} m, {:.2e} m allowed", s.max_penetration_m, depth);
  };
}

void add_steps(std::vector<ExtremeScene>* rows) {
  for (const double h : {1e-5, 1e-3, 0.1, 1.0, 10.0})
    rows->push_back({"time step",
                     fmt::format("stack of 5 at rest, h = {:g} s, 20 steps", h),
                     "stays at rest",
                     {Ending::stable},
                     [h] {
                       return Scene{motion(0.4, 1e-9, h, 20, Analysis::Start::static_),
                                    testing::stack_of_cubes(1.0, std::vector<double>(5, 2000.0))};
                     },
                     sinks_less_than(1e-3)});
  for (const double h : {1e-4, 0.01, 1.0})
    rows->push_back({"time step",
                     fmt::format("rigid stack of 5, h = {:g} s, 20 steps", h),
                     "stays at rest",
                     {Ending::stable},
                     [h] {
                       return Scene{motion(0.4, 0.0, h, 20, Analysis::Start::rest),
                                    testing::stack_of_cubes(1.0, std::vector<double>(5, 2000.0))};
                     },
                     sinks_less_than(1e-6)});
  rows->push_back({"time step",
                   "heavy on light, ratio 1e6, h = 0.01 s, 200 steps",
                   "penetration below 1e-4 of the side",
                   {Ending::stable, Ending::moving},
                   [] {
                     return Scene{motion(0.4, 1e-14, 0.01, 200, Analysis::Start::rest),
                                  testing::stack_of_cubes(1.0, {1.0, 1e6})};
                   },
                   sinks_less_than(1e-4)});
}

void add_falls(std::vector<ExtremeScene>* rows) {
  rows->push_back(
      {"fall",
       "an unsupported block, 1 s",
       "collapsed, after a fall of g t^2 / 2",
       {Ending::collapsed},
       [] {
         return Scene{motion(0.4, 1e-9, 0.01, 100, Analysis::Start::rest), testing::make_boxes({BoxSpec{}})};
       },
       [](const Summary& s, const Frame&) {
         // Fall of n steps of implicit Euler: g h^2 n (n + 1) / 2.
         const double fallen = 9.81 * 0.01 * 0.01 * 100 * 101 / 2;
         return std::abs(s.max_displacement_m.value() - fallen) < 1e-9 * fallen
                    ? std::string()
                    : fmt::format("fell {} m, expected {} m", *s.max_displacement_m, fallen);
       }});
  rows->push_back({"fall",
                   "a cube dropped 5 m on a stack at h = 0.1 s",
                   "penetration below half its side",
                   {Ending::stable, Ending::moving, Ending::collapsed},
                   [] {
                     return Scene{
                         motion(0.4, 1e-9, 0.1, 40, Analysis::Start::rest),
                         testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                              {.center = {0, 0, 0.5}},
                                              {.center = {0, 0, 6.5}}})};
                   },
                   sinks_less_than(0.5)});
}

/// Painleve's paradox: a slender rod that slides on its lower end at a friction above 4/3. The rigid problem
/// with Coulomb's law has no solution at some speeds; the convex (associated) law always has one.
void add_painleve(std::vector<ExtremeScene>* rows) {
  for (const double mu : {1.4, 3.0})
    rows->push_back(
        {"Painleve",
         fmt::format("sliding rod, mu {:g}", mu),
         "any ending, speeds below 100 m/s",
         {Ending::stable, Ending::moving, Ending::collapsed},
         [mu] {
           const Eigen::Quaterniond lean(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
           const Vec3 size(0.02, 0.02, 1.0);
           const double foot = 0.5 * (size.z() * std::cos(0.4) + size.x() * std::sin(0.4));
           Scene scene{motion(mu, 0.0, 1e-3, 300, Analysis::Start::rest),
                       testing::make_boxes({{.center = {0, 0, -0.5}, .size = {40, 3, 1}, .fixed = true},
                                            {.center = {0, 0, foot}, .size = size, .rotation = lean}})};
           // Gravity pulls along the floor against the lean, so that the rod slides like a piece of chalk
           // that is pushed.
           scene.input.loads.gravity = Vec3(40.0, 0.0, -9.81);
           return scene;
         },
         [](const Summary& s, const Frame&) {
           return s.max_speed_m_per_s.value() < 100.0 ? std::string()
                                                      : fmt::format("{} m/s", *s.max_speed_m_per_s);
         }});
}

void add_moving_gaps(std::vector<ExtremeScene>* rows) {
  rows->push_back({"overlap",
                   "a cube 1 mm inside the floor, h = 0.01 s",
                   "pushed out at the recovery speed",
                   {Ending::stable},
                   [] {
                     Scene scene{
                         motion(0.4, 1e-12, 0.01, 300, Analysis::Start::rest),
                         testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                              {.center = {0, 0, 0.499}, .size = {1, 1, 1}}})};
                     scene.input.analysis.recovery_speed = 0.01;
                     return scene;
                   },
                   sinks_less_than(1e-6)});
}

}  // namespace

Assembly wedge(double lean_deg) {
  const double slope = std::tan(lean_deg * std::numbers::pi / 180.0);
  Assembly assembly;
  assembly.title = "wedge";
  // x of the two joints at the bottom and at the top.
  const double foot = 0.5, head = 0.5 + slope;
  testing::add_voussoir({Eigen::Vector2d{-foot - 2, 0}, {-foot, 0}, {-head, 1}, {-head - 2, 1}}, 1.0, 2000.0,
                        true, 0, &assembly);
  testing::add_voussoir({Eigen::Vector2d{foot, 0}, {foot + 2, 0}, {head + 2, 1}, {head, 1}}, 1.0, 2000.0,
                        true, 0, &assembly);
  testing::add_voussoir({Eigen::Vector2d{-foot, 0}, {foot, 0}, {head, 1}, {-head, 1}}, 1.0, 2000.0, false, 0,
                        &assembly);
  compute_mass_properties(&assembly);
  return assembly;
}

void add_dynamic_rows(std::vector<ExtremeScene>* rows) {
  add_steps(rows);
  add_falls(rows);
  add_painleve(rows);
  add_moving_gaps(rows);
}

void add_refused_rows(std::vector<ExtremeScene>* rows) {
  for (const char* setting :
       {"joints.friction=-0.1", "joints.friction=.nan", "joints.compliance.normal=-1e-9",
        "material.density=-1", "material.density=.inf", "analysis.tolerance=0",
        "geometry.surface.thickness=0"})
    rows->push_back({"contradiction", setting, "refused with a message", {Ending::refused}, [setting] {
                       const Case input = read_case(CUPOLA_SOURCE_DIR "/cases/wall_large.yaml", {setting});
                       return Scene{input, generate(input)};
                     }});
}

const std::vector<ExtremeScene>& extreme_scenes() {
  static const std::vector<ExtremeScene> rows = [] {
    std::vector<ExtremeScene> all;
    add_static_rows(&all);
    add_dynamic_rows(&all);
    add_refused_rows(&all);
    return all;
  }();
  return rows;
}

}  // namespace cupola
