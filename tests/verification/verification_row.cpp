#include "tests/verification/verification_row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"

namespace cupola::verification {
namespace {

double error_of(const Reference& problem, const ReferenceRow& row, double computed) {
  if (row.is_interval()) return std::max({0.0, row.low - computed, computed - row.high});
  const double difference = std::abs(computed - row.expected());
  if (problem.error == "absolute") return difference;
  if (row.expected() == 0.0) throw InputError(problem.id + ": a relative error of zero");
  return difference / std::abs(row.expected());
}

}  // namespace

const Computations& computations() {
  static const Computations all = [] {
    Computations map;
    add_block_rows(&map);
    add_motion_rows(&map);
    add_arch_rows(&map);
    add_wall_rows(&map);
    add_dome_rows(&map);
    add_invariance_rows(&map);
    add_convergence_rows(&map);
    add_range_rows(&map);
    add_strength_rows(&map);
    add_feature_rows(&map);
    return map;
  }();
  return all;
}

RowResult run_row(const Reference& problem, const ReferenceRow& row) {
  RowResult result;
  const double start = cpu_seconds();
  try {
    result.computed = computations().at(problem.id)(row);
    result.error = error_of(problem, row, result.computed);
    result.passed = result.error <= problem.tolerance;  // false for NaN
  } catch (const std::exception& failure) {
    result.computed = result.error = std::numeric_limits<double>::quiet_NaN();
    result.failure = failure.what();
  }
  result.cpu_seconds = cpu_seconds() - start;
  return result;
}

}  // namespace cupola::verification
