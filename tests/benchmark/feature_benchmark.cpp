// Cost of features: counts and processor time of the analysis of the same scene with and without each
// feature, as CSV; shortest time of three runs.

#include <algorithm>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/program/program.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/simulation.hpp"
#include "solver/explain.hpp"
#include "solver/runtime/blas_kernels.hpp"
#include "tests/arguments.hpp"
#include "tests/solver/scenes.hpp"

namespace {

using namespace cupola;

struct Measured {
  ModelCounts counts;
  long long factor_entries = 0;
  double seconds = 0.0;  // processor time
};

double best_of_three(const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double started = cpu_seconds();
    work();
    best = std::min(best, cpu_seconds() - started);
  }
  return best;
}

Measured measure(const Case& input, const Assembly& assembly) {
  const ModelExplanation e = explain_model(input, assembly);
  return {e.counts, e.cost.factor_entries, best_of_three([&] { run_analysis(input, assembly, {}); })};
}

Measured measure(const std::string& name, const std::vector<std::string>& settings) {
  const Case input = read_case(CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml", settings);
  return measure(input, generate(input));
}

void print_row(const char* scene, const char* feature, const Measured& with, const Measured& without) {
  fmt::print("{},\"{}\",{} / {},{} / {},{} / {},{:.3f} / {:.3f},{:.2f}\n", scene, feature,
             with.counts.unknowns, without.counts.unknowns, with.counts.contacts, without.counts.contacts,
             with.factor_entries, without.factor_entries, with.seconds, without.seconds,
             with.seconds / without.seconds);
}

/// Joints of mortar. The same dome without strength has the same contact points only with compliance per
/// area.
void strength_rows(const std::string& dome, const Measured& plain) {
  const std::string compliance = "joints.compliance={per: area, normal: 1e-10, tangential: 2.4e-10}";
  for (const int subdivide : {1, 2}) {
    const std::vector<std::string> dry{compliance, fmt::format("contact.subdivide={}", subdivide)};
    const auto with = [&dry](std::vector<std::string> strengths) {
      strengths.insert(strengths.begin(), dry.begin(), dry.end());
      return strengths;
    };
    const std::string points = subdivide == 1 ? "" : fmt::format(", subdivide {}", subdivide);
    const Measured without = measure(dome, dry);
    const Measured full = measure(
        dome, with({"joints.tension=1e5", "joints.cohesion=1.5e5", "joints.compressive_strength=2.5e6"}));
    const auto row = [&](const char* feature, const Measured& strong, const Measured& weak) {
      print_row("dome_circular", (feature + points).c_str(), strong, weak);
    };
    row("compressive strength that is never reached",
        measure(dome, with({"joints.compressive_strength=1e12"})), without);
    row("compressive strength of 2.5 MPa", measure(dome, with({"joints.compressive_strength=2.5e6"})),
        without);
    row("all strengths", full, without);
    row("all strengths, beside the dry dome of the case", full, plain);
  }
}

/// Time per step of a hundred stacks of ten cubes that have come to rest, with and without sleep.
double seconds_per_step(bool sleep) {
  std::vector<testing::BoxSpec> boxes{{.center = {150, 0, -0.5}, .size = {400, 3, 1}, .fixed = true}};
  for (int k = 0; k < 100; ++k)
    for (int level = 0; level < 10; ++level) boxes.push_back({.center = {3.0 * k, 0, level + 0.5}});
  const Assembly assembly = testing::make_boxes(boxes);
  Case input;
  input.joints.compliance = {1e-9, 1e-9, Compliance::Per::point};
  SimulationOptions options;
  options.step.h = 0.01;
  if (sleep) options.sleep = Sleep{.speed = 1e-2, .time = 0.05};
  options.detection = detection_options(input);
  options.solve = contact_solver_options(input.analysis);
  options.solve.tolerance = 1e-6;
  Simulation run(make_model(input, assembly), options);
  for (int k = 0; k < 60; ++k) run.advance();  // until all stacks are at rest
  return best_of_three([&] {
           for (int k = 0; k < 10; ++k) run.advance();
         }) /
         10.0;
}

void print_table() {
  fmt::print("scene,feature,unknowns with / without,contacts,factor entries,CPU s,ratio\n");
  const std::string dome = "dome_circular";
  const Measured plain = measure(dome, {});
  print_row("dome_circular", "friction", plain, measure(dome, {"joints.friction=0"}));
  const auto dome_row = [&](const char* feature, const std::vector<std::string>& settings) {
    print_row("dome_circular", feature, measure(dome, settings), plain);
  };
  dome_row("Coulomb's law instead of the associated one", {"analysis.friction_law=coulomb"});
  dome_row("compliance per area", {"joints.compliance.per=area"});
  strength_rows(dome, plain);
  dome_row("zero compliance", {"joints.compliance.normal=0", "joints.compliance.tangential=0"});
  dome_row("a lantern", {"loads.lantern.weight_fraction=0.02"});
  dome_row("perturbed GJK", {"contact.method=perturbed_gjk"});
  dome_row("motion of 10 steps", {"analysis.type=dynamic", "analysis.duration=0.1"});
  print_row("wall_small", "motion in the plane only", measure("wall_small", {"analysis.plane=true"}),
            measure("wall_small", {}));
  const double awake = seconds_per_step(false), asleep = seconds_per_step(true);
  fmt::print("1000 blocks at rest,sleep (per step),,,,{:.2e} / {:.2e},{:.4f}\n", asleep, awake,
             asleep / awake);
}

}  // namespace

int main(int argc, char** argv) {
  cupola::use_kernels_of_processor(argv);
  return run_program("feature_benchmark", [&] {
    read_arguments(argc, argv, 0, 0, "feature_benchmark");
    print_table();
    return ExitCode::done;
  });
}
