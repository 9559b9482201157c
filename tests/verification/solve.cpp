#include "tests/verification/solve.hpp"

#include <cmath>
#include <stdexcept>

#include "assembly/case/case_reader.hpp"
#include "solver/analysis/analysis.hpp"

namespace cupola::verification {
namespace {

constexpr double kBracket = 1e-4;

Equilibrium run(const Case& scene, const Assembly& assembly) {
  Equilibrium result;
  AnalysisSinks sinks;
  sinks.frame = [&result](const Frame& frame) { result.frame = frame; };
  result.summary = run_static(scene, assembly, sinks);
  return result;
}

}  // namespace

Equilibrium solve_equilibrium(const Case& scene, const Assembly& assembly) {
  Equilibrium result = run(scene, assembly);
  if (!stands(result.summary.status)) throw std::runtime_error(result.summary.message);
  return result;
}

bool stands(const Case& scene, const Assembly& assembly) {
  const Summary summary = run(scene, assembly).summary;
  if (summary.status == Status::unconverged) throw std::runtime_error(summary.message);
  return stands(summary.status);
}

double critical_value(const Case& scene, const Assembly& assembly) {
  const Summary summary = run_limit(scene, assembly, {}).value();
  // A trial that does not converge may leave a bracket somewhat wider than requested.
  if (!summary.critical || std::abs(summary.critical->stable - summary.critical->moving) >
                               2.0 * summary.accuracy.asked * std::abs(summary.critical->value))
    throw std::runtime_error(summary.message);
  return summary.critical->value;
}

double critical_factor(double low, double high, const std::function<bool(double)>& stands_at) {
  if (!stands_at(low) || stands_at(high))
    throw std::runtime_error("the ends of the bracket do not differ in stability as expected");
  while (high - low > kBracket * low) {
    const double middle = 0.5 * (low + high);
    (stands_at(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Case limit_case(LimitSearch::Parameter parameter, double low, double high, double friction) {
  Case scene;
  scene.joints.friction = friction;
  scene.joints.compliance = {1e-8, 1e-8, Compliance::Per::point};
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.limit.parameter = parameter;
  scene.analysis.limit.low = low;
  scene.analysis.limit.high = high;
  scene.analysis.limit.relative_width = kBracket;
  return scene;
}

JointForces joint_forces(const Frame& frame) {
  JointForces forces;
  const ContactTable& contacts = frame.contacts;
  for (int i = 0; i < contacts.size(); ++i)
    forces.try_emplace({contacts.block_a[i], contacts.block_b[i]}, Vec3::Zero()).first->second +=
        contacts.force[i];
  return forces;
}

Case repository_case(const std::string& name, const std::vector<std::string>& settings) {
  return read_case(CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml", settings);
}

}  // namespace cupola::verification
