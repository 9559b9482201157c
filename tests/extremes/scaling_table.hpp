#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// Prints verdict, iterations and forces of ten random models near their limits under compliances that follow
/// from size and weight, and by how much lengths times 2^-10 to 2^10 and weights times 2^-6 to 2^6 change
/// them, comma-separated. Fails if a verdict or a number of iterations changes, or forces by more than 1e-10
/// of the largest.
ExitCode print_scaling();

}  // namespace cupola
