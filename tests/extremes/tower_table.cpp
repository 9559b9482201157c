#include "tests/extremes/tower_table.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

Case tower_case(FrictionLaw law) {
  Case scene = statics(0.7, 1e-9, 1e-5);
  scene.analysis.friction_law = law;
  return scene;
}

/// The verdict at a factor on the limit; false if it is wrong.
bool print_verdict(const Assembly& tower, double limit, double factor, FrictionLaw law) {
  Case scene = tower_case(law);
  const double tilt = factor * limit, g = scene.loads.gravity.norm();
  scene.loads.gravity = g * Vec3(std::sin(tilt), 0.0, -std::cos(tilt));
  const double started = cpu_seconds();
  const Summary summary = run_static(scene, tower, {});
  fmt::print("{},{:.1f},", to_string(summary.status), cpu_seconds() - started);
  const bool refuted = factor > 1.0 ? summary.status == Status::stable : moves(summary.status);
  return !refuted;
}

bool print_limit(const Assembly& tower, double limit, FrictionLaw law) {
  Case scene = tower_case(law);
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = LimitSearch::Parameter::tilt;
  scene.analysis.limit.method = LimitSearch::Method::bisection;
  scene.analysis.limit.low = 0.61 * limit * kDegrees;
  scene.analysis.limit.high = 1.5 * limit * kDegrees;
  const double started = cpu_seconds();
  const Summary summary = run_limit(scene, tower, {}).value();
  const double seconds = cpu_seconds() - started;
  if (!summary.critical) {
    fmt::print("{},,,{:.1f}\n", to_string(summary.status), seconds);
    return true;
  }
  const CriticalValue& found = *summary.critical;
  const double exact = limit * kDegrees;
  fmt::print("{},{:.1e},{:.1e},{:.1f}\n", to_string(summary.status),
             0.5 * (found.moving - found.stable) / found.value, std::abs(found.value - exact) / exact,
             seconds);
  return found.stable <= exact && found.moving >= exact;
}

}  // namespace

ExitCode print_towers() {
  bool right = true;
  fmt::print("cubes,law,at 0.5,s,at 0.999,s,at 1.001,s,limit by bisection,stated error,true error,s\n");
  for (const int cubes : {50, 100, 200, 500})
    for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
      const Assembly tower = pile(std::vector<Vec3>(static_cast<size_t>(cubes), Vec3::Ones()));
      const double limit = std::atan(1.0 / cubes);
      fmt::print("{},{},", cubes, to_string(law));
      for (const double factor : {0.5, 0.999, 1.001})
        right = print_verdict(tower, limit, factor, law) && right;
      right = print_limit(tower, limit, law) && right;
      std::fflush(stdout);
    }
  return right ? ExitCode::done : ExitCode::failed;
}

}  // namespace cupola
