// Cost of features: counts and processor time of the same scene with and without each feature, and their
// ratio.
//
//   feature_benchmark             prints a table; shortest time of three runs

#include <algorithm>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/simulation.hpp"
#include "solver/explain.hpp"
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

void print_row(const char* feature, const Measured& with, const Measured& without) {
  const auto ratio = [](double a, double b) {
    return b > 0.0 ? fmt::format("{:.2f}", a / b) : std::string("-");
  };
  fmt::print("{:<34}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}{:>11}{:>11}{:>9.3f}{:>9.3f}{:>7}\n", feature,
             with.counts.unknowns, without.counts.unknowns, with.counts.contacts, without.counts.contacts,
             with.counts.force_rows, without.counts.force_rows, with.factor_entries, without.factor_entries,
             with.seconds, without.seconds, ratio(with.seconds, without.seconds));
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

}  // namespace

int main() {
  fmt::print("{:<34}{:>16}{:>18}{:>18}{:>22}{:>18}{:>7}\n", "feature: with, without", "unknowns", "contacts",
             "force rows", "factor entries", "s", "ratio");
  const std::string dome = "dome_circular", wall = "wall_small";
  const Measured dome_plain = measure(dome, {});
  print_row("friction", dome_plain, measure(dome, {"joints.friction=0"}));
  print_row("Coulomb instead of associated", measure(dome, {"analysis.friction_law=coulomb"}), dome_plain);
  print_row("compliance per area", measure(dome, {"joints.compliance.per=area"}), dome_plain);
  print_row("zero compliance",
            measure(dome, {"joints.compliance.normal=0", "joints.compliance.tangential=0"}), dome_plain);
  print_row("a lantern", measure(dome, {"loads.lantern.weight_fraction=0.02"}), dome_plain);
  print_row("perturbed GJK", measure(dome, {"contact.method=perturbed_gjk"}), dome_plain);
  print_row("motion, 10 steps", measure(dome, {"analysis.type=dynamic", "analysis.duration=0.1"}),
            dome_plain);
  print_row("a plane wall in space, in the plane", measure(wall, {}), measure(wall, {"analysis.plane=true"}));
  const double awake = seconds_per_step(false), asleep = seconds_per_step(true);
  fmt::print("1,000 blocks at rest, per step: {:.2e} s awake, {:.2e} s asleep, ratio {:.4f}\n", awake, asleep,
             asleep / awake);
  return 0;
}
