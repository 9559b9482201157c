// Motion in time.

#include <cmath>

#include <fmt/format.h>

#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

/// A dynamic case of `steps` steps of h from the unloaded assembly, to a momentum residual of 1e-8.
Case motion(double mu, double compliance, double h, int steps) {
  Case input = testing::make_case(mu, compliance, h);
  input.analysis.tolerance = 1e-8;
  input.analysis.duration = h * steps;
  input.analysis.start = Analysis::Start::rest;
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

void add_stacks(Rows* rows) {
  rows->push_back({"motion",
                   "rigid stack of 5 at rest, h = 10 s, 20 steps",
                   "stays; weight above each cube",
                   {Ending::stable},
                   [] {
                     return Scene{motion(0.4, 0.0, 10.0, 20), pile(std::vector<Vec3>(5, Vec3::Ones()))};
                   },
                   carries_weight_above,
                   // the tolerance 1e-8 of the free fall g h^2 of one step
                   sinks_less_than(1e-8 * 9.81 * 10.0 * 10.0)});
  rows->push_back({"motion",
                   "heavy on light, ratio 1e6, 200 steps of 0.01 s",
                   "weight above; penetration < 1e-4 of the side",
                   {Ending::stable},
                   [] {
                     return Scene{motion(0.4, 1e-14, 0.01, 200), testing::stack_of_cubes(1.0, {1.0, 1e6})};
                   },
                   carries_weight_above,
                   sinks_less_than(1e-4)});
  rows->push_back({"motion",
                   "a cube dropped 5 m on a cube, h = 0.1 s",
                   "penetration below half the side",
                   {Ending::stable, Ending::moving, Ending::collapsed},
                   [] {
                     return Scene{
                         motion(0.4, 1e-9, 0.1, 40),
                         testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                              {.center = {0, 0, 0.5}},
                                              {.center = {0, 0, 6.5}}})};
                   },
                   {},
                   sinks_less_than(0.5)});
}

constexpr double kLean = 0.4;   // rad, of the rod from the vertical
constexpr double kPull = 40.0;  // m/s2, along the floor

/// Painleve's rod: slender, sliding on its lower end like a piece of chalk that is pushed, at a friction
/// above 4/3. The rigid problem with Coulomb's law has no solution, or several, at some states.
Scene painleve_rod(double mu, FrictionLaw law) {
  const Eigen::Quaterniond lean(Eigen::AngleAxisd(kLean, Vec3::UnitY()));
  const Vec3 size(0.02, 0.02, 1.0);
  const double foot = 0.5 * (size.z() * std::cos(kLean) + size.x() * std::sin(kLean));
  Scene scene{motion(mu, 0.0, 1e-3, 300),
              testing::make_boxes({{.center = {0, 0, -0.5}, .size = {40, 3, 1}, .fixed = true},
                                   {.center = {0, 0, foot}, .size = size, .rotation = lean}})};
  scene.input.loads.gravity = Vec3(kPull, 0.0, -testing::kG);
  scene.input.analysis.friction_law = law;
  return scene;
}

/// Contact and friction do no positive work: the kinetic energy is at most the work of gravity.
std::string gains_no_energy(const Scene& scene, const Frame& frame) {
  const Block& rod = scene.assembly.blocks[1];
  const Vec3 omega = frame.blocks.angular_velocity[1];
  const Eigen::Vector4d q = frame.blocks.quaternion_wxyz[1];
  const Mat3 R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const double kinetic = 0.5 * rod.mass * frame.blocks.velocity[1].squaredNorm() +
                         0.5 * omega.dot(R * rod.inertia * R.transpose() * omega);
  const double work = rod.mass * scene.input.loads.gravity.dot(frame.blocks.displacement[1]);
  return kinetic <= work * (1 + 1e-9)
             ? ""
             : fmt::format("kinetic energy {} J above the work of gravity {} J", kinetic, work);
}

void add_painleve(Rows* rows) {
  for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb})
    for (const double mu : {1.4, 3.0})
      rows->push_back({"motion",
                       fmt::format("Painleve's rod, mu {:g}, {}", mu, name_of(law)),
                       "kinetic energy at most the work of gravity",
                       {Ending::stable, Ending::moving, Ending::collapsed},
                       [=] { return painleve_rod(mu, law); },
                       [](const Scene& scene, const Summary&, const Frame& frame) {
                         TrueError error;
                         error.refuted = gains_no_energy(scene, frame);
                         return error;
                       }});
}

/// SPG balances momentum to rounding in every iteration. Its error is in the contact law.
void add_budget(Rows* rows) {
  rows->push_back({"motion",
                   "wall of 210 blocks by SPG, 20 iterations a step",
                   "must end unconverged: the law is violated",
                   {},
                   [] {
                     const Case input = read_case(
                         CUPOLA_SOURCE_DIR "/cases/wall_medium.yaml",
                         {"analysis.type=dynamic", "analysis.method=spg", "analysis.max_iterations=20",
                          "analysis.time_step=0.01", "analysis.duration=0.2"});
                     return Scene{input, generate(input)};
                   }});
}

}  // namespace

void add_motion_rows(Rows* rows) {
  add_stacks(rows);
  add_painleve(rows);
  add_budget(rows);
}

}  // namespace cupola
