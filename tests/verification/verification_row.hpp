#pragma once

#include <functional>
#include <map>
#include <numbers>
#include <string>

#include "tests/verification/references.hpp"

namespace cupola::verification {

constexpr double kRadians = std::numbers::pi / 180.0;  ///< radians in a degree

/// Computes the quantity of one row; throws std::exception if the run gives none.
using Computation = std::function<double(const ReferenceRow&)>;
using Computations = std::map<std::string, Computation>;

void add_block_rows(Computations* all);
void add_motion_rows(Computations* all);
void add_arch_rows(Computations* all);
void add_wall_rows(Computations* all);
void add_dome_rows(Computations* all);
void add_invariance_rows(Computations* all);
void add_convergence_rows(Computations* all);
void add_range_rows(Computations* all);
void add_strength_rows(Computations* all);
void add_feature_rows(Computations* all);

/// The computation of every problem in references.yaml, by its id.
const Computations& computations();

/// Result of one row.
struct RowResult {
  double computed = 0.0;
  double error = 0.0;   ///< relative or absolute, as the problem says; distance from an interval is absolute
  bool passed = false;  ///< the computation ended and error <= tolerance
  std::string failure;  ///< why there is no number; "" if there is one
  double cpu_seconds = 0.0;
};
RowResult run_row(const Reference& problem, const ReferenceRow& row);

}  // namespace cupola::verification
