// Time integrators, fracture along paths, staged building, chains, drums and windows.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/csv_numbers.hpp"
#include "tests/generators/models.hpp"
#include "tests/verification/motion.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

using testing::kG;
using testing::make_case;

/// What a run of any analysis writes last.
struct LastState {
  Summary summary;
  Frame frame;
  std::string table;
};

LastState run_to_end(const Case& scene, const Assembly& assembly) {
  LastState last;
  AnalysisSinks sinks;
  sinks.frame = [&last](const Frame& frame) { last.frame = frame; };
  sinks.table = [&last](const std::string&, const std::string& text) { last.table = text; };
  last.summary = run_analysis(scene, assembly, sinks).value();
  if (last.summary.status == Status::unconverged) throw std::runtime_error(last.summary.message);
  return last;
}

/// Height of a cube on springs, w = 20 rad/s, dropped from touching them: y = -g / w^2 (1 - cos w t).
constexpr double kFrequency = 20.0, kSpring = 1e-5;  // rad/s; m/N of each of four contacts

double alpha_height(double h, double end) {
  Case scene = make_case(0.4, kSpring, h);
  scene.analysis.integrator = TimeIntegrator::generalized_alpha;
  Motion motion(scene, testing::box_on_floor({1, 1, 1}));
  motion.advance(static_cast<int>(std::lround(end / h)));
  return motion.state().poses[1].p_WB.z() - 0.5;
}

double exact_height(double time) {
  return -kG / (kFrequency * kFrequency) * (1.0 - std::cos(kFrequency * time));
}

double alpha_order(const ReferenceRow& row) {
  const double h = row.number("step_s"), end = 0.05;
  const auto error = [&](double step) { return std::abs(alpha_height(step, end) - exact_height(end)); };
  return std::log2(error(2.0 * h) / error(h));
}

/// Error of the height after 0.05 s, over the errors that the steps were allowed together.
double adaptive_error(const ReferenceRow& row) {
  Case scene = make_case(0.4, kSpring, 1e-3);
  scene.analysis.time_error = row.number("time_error_m");
  scene.analysis.adaptive.emplace();
  scene.analysis.adaptive->displacement_error = *scene.analysis.time_error;
  scene.analysis.duration = 0.05;
  scene.analysis.thresholds.displacement = 1.0;
  const LastState last = run_to_end(scene, testing::box_on_floor({1, 1, 1}));
  const double error = last.frame.blocks.displacement[1].z() - exact_height(last.frame.time);
  return std::abs(error) / (last.summary.steps * *scene.analysis.time_error);
}

/// J: work that breaks the bed of 1 m x 0.5 m between two blocks, whose support opens or shears it.
double fracture_work(const ReferenceRow& row) {
  const FractureEnergy energy{20.0, 100.0};    // N/m
  const JointStrength strength{2.5e5, 3.5e5};  // Pa
  const Assembly couplet =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                           {.center = {0, 0, 0.1}, .size = {1, 0.5, 0.2}, .ring = 0},
                           {.center = {0, 0, 0.3}, .size = {1, 0.5, 0.2}, .ring = 1},
                           {.center = {0, 0, 0.5}, .size = {1, 0.5, 0.2}, .fixed = true}});
  Case scene = make_case(0.0, 0.0, 0.01);
  scene.joints.compliance = {1e-11, 1e-11, Compliance::Per::area};
  scene.joints.strength = strength;
  scene.joints.failure = JointFailure::softening;
  scene.joints.fracture_energy = energy;
  scene.joints.base.emplace();
  scene.joints.base->tension = scene.joints.base->cohesion = 1e9;
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-6;
  scene.analysis.path.steps = row.integer("steps");
  scene.analysis.path.control = LoadPath::Control{BlockRef{3}, {}, Vec3::UnitZ()};
  const bool opens = row.text("mode") == "opening";
  const double broken =
      opens ? 2.0 * energy.tension / strength.tension : 2.0 * energy.shear / strength.cohesion;
  scene.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                  .displacement = 1.5 * broken * (opens ? Vec3::UnitZ() : Vec3::UnitX()),
                                  .time = RampInTime{}});
  return test::csv_numbers(run_to_end(scene, couplet).table).back()[3];
}

/// m: settlement of a cube of a column of four that are laid one after the other.
double staged_settlement(const ReferenceRow& row) {
  Case scene = make_case(0.4, 0.0, 0.01);
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.analysis.type = AnalysisType::staged;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.staged.carry = true;
  scene.analysis.staged.fresh.normal = 5e-9;
  const Assembly column = testing::stack_of_cubes(1.0, std::vector<double>(4, 1000.0));
  return -run_to_end(scene, column).frame.blocks.displacement[row.integer("cube")].z();
}

/// N: tension of a chain round n blocks on a smooth floor, each of which is pushed outwards by 1000 N.
double chain_tension(const ReferenceRow& row) {
  const int n = row.integer("links");
  const double radius = 5.0;
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true}};
  Case scene;
  scene.joints.friction = 0.0;
  scene.analysis.tolerance = 1e-10;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    const Vec3 outwards(std::cos(angle), std::sin(angle), 0.0);
    boxes.push_back({.center = radius * outwards + Vec3(0, 0, 0.25), .size = {0.5, 0.5, 0.5}});
    scene.loads.forces.push_back({BlockRef{i + 1}, boxes.back().center, 1000.0 * outwards, {}});
  }
  Assembly assembly = testing::make_boxes(boxes);
  assembly.chains = {{"ring", 0.25}};
  for (int i = 0; i < n; ++i) {
    const int a = std::min(i, (i + 1) % n), b = std::max(i, (i + 1) % n);
    BuiltTie tie{
        .block_a = a + 1, .block_b = b + 1, .point_a = boxes[a + 1].center, .point_b = boxes[b + 1].center};
    tie.stiffness = 1e9;
    tie.length = (tie.point_a - tie.point_b).norm();
    tie.chain = 0;
    assembly.ties.push_back(tie);
  }
  return solve_equilibrium(scene, assembly).frame.ties.force[0];
}

/// m3: volume of the drum of an octagonal vault, without its openings.
double drum_volume(const ReferenceRow& row) {
  Case scene;
  OctagonalVault vault;
  vault.span = 10.0;
  vault.thickness = 0.6;
  scene.geometry.surface = vault;
  scene.geometry.bond = RunningBond{8, 24, 2};
  Member drum = octagonal_drum(10.0, 3.0, 1.0, RunningBond{6, 24, 2});
  if (const double width = row.number("opening_m"); width > 0.0) {
    Openings group;
    group.width = width;
    group.height = 1.0;
    group.sill = 1.0;
    group.bearing = 0.4;
    drum.openings = {group};
  }
  scene.geometry.members = {drum};
  scene.geometry.on = "drum";
  const Assembly assembly = generate(scene);
  double sum = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed && assembly.members[block.member].starts_with("drum")) sum += block.volume;
  return sum;
}

/// Factor on a lantern of 800 kN at which the vault on its drum falls.
double drum_lantern(const ReferenceRow& row) {
  const Case scene =
      repository_case("pavilion_window", {"geometry.members[0].surface.thickness=" + row.text("drum_m")});
  const Assembly assembly = generate(scene);
  return critical_value(scene, assembly) * free_weight(assembly, kG) / 800e3;
}

}  // namespace

void add_feature_rows(Computations* all) {
  Computations& rows = *all;
  rows["alpha_order"] = alpha_order;
  rows["adaptive_error"] = adaptive_error;
  rows["fracture_work"] = fracture_work;
  rows["staged_settlement"] = staged_settlement;
  rows["chain_tension"] = chain_tension;
  rows["drum_volume"] = drum_volume;
  rows["drum_lantern"] = drum_lantern;
}

}  // namespace cupola::verification
