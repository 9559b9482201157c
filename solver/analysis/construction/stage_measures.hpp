#pragma once

#include <optional>

#include "assembly/model/results.hpp"
#include "solver/analysis/construction/construction.hpp"

namespace cupola {

// What is recorded of a stage, of its last solve and before accept().

/// With all blocks of the assembly.
Frame stage_frame(const Construction& building, const StaticSolution& solution);

/// m: by which the most compressed fresh head joint has closed since it was laid, in equilibrium.
double head_squeeze(const Construction& building, const StaticSolution& solution);

/// m: largest displacement of a block since it was laid, in equilibrium.
double largest_displacement(const Construction& building, const StaticSolution& solution);

/// The contact with the largest violation of its law, if that exceeds `worst`.
std::optional<LawViolation> violation_above(const std::optional<LawViolation>& worst,
                                            const Construction& building, const StaticSolution& solution,
                                            double time);

}  // namespace cupola
