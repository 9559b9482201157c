#include "tests/extremes/scaling_table.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/case/limit_parameter.hpp"
#include "assembly/model/relative_compliance.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/extremes/limit_models.hpp"
#include "tests/scaled_assembly.hpp"

namespace cupola {
namespace {

struct Run {
  Summary summary;
  Frame frame;
};

Run solve(Case scene, const Assembly& assembly) {
  scene.joints.compliance = {0.0, 0.0, Compliance::Per::area, 1e-4};
  resolve_compliance(assembly, scene.loads.gravity, &scene.joints.compliance);
  Run run;
  AnalysisSinks sinks;
  sinks.frame = [&run](const Frame& frame) { run.frame = frame; };
  run.summary = run_static(scene, assembly, sinks);
  return run;
}

/// Largest difference of the contact forces over the largest force; infinite if the contacts differ.
double force_difference(const Run& one, const Run& other, double weight) {
  if (one.frame.contacts.size() != other.frame.contacts.size()) return INFINITY;
  double largest = 0.0, difference = 0.0;
  for (int i = 0; i < one.frame.contacts.size(); ++i) {
    const Vec3& force = one.frame.contacts.force[i];
    largest = std::max(largest, force.norm());
    difference = std::max(difference, (other.frame.contacts.force[i] / weight - force).norm());
  }
  return largest > 0.0 ? difference / largest : 0.0;
}

/// A static analysis at a factor on the limit. Returns false if scaling changes it.
bool print_row(const LimitModel& model, double factor) {
  constexpr double kDifference = 1e-10;
  const double limit = run_limit(model.scene.input, model.scene.assembly, {}).value().critical.value().value;
  Case scene = case_at(model.scene.input, model.stands_above ? limit / factor : limit * factor);
  scene.analysis.type = AnalysisType::static_;
  const Run one = solve(scene, model.scene.assembly);
  int verdicts = 0, iterations = 0;
  double difference = 0.0;
  for (const auto& [length, weight] : kScales) {
    const Run other = solve(scene, scaled(model.scene.assembly, length, weight));
    verdicts += other.summary.status != one.summary.status;
    iterations += other.summary.iterations != one.summary.iterations;
    difference = std::max(difference, force_difference(one, other, weight));
  }
  fmt::print("{},{},{:g},{},{},{},{},{:.1e}\n", model.name, model.scene.assembly.blocks.size(), factor,
             to_string(one.summary.status), one.summary.iterations, verdicts, iterations, difference);
  return verdicts == 0 && iterations == 0 && difference <= kDifference;
}

}  // namespace

ExitCode print_scaling() {
  bool same = true;
  fmt::print(
      "model,blocks,factor on the limit,verdict,iterations,scales with another verdict,with other "
      "iterations,largest difference of forces\n");
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LimitModel model = limit_model(seed);
    for (const double factor : {0.99, 1.01}) same = print_row(model, factor) && same;
  }
  return same ? ExitCode::done : ExitCode::failed;
}

}  // namespace cupola
