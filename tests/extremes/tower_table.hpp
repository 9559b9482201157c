#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// Prints verdicts and limits of towers of 50 to 500 cubes under tilt, whose limit is atan(1 / cubes),
/// comma-separated. Fails if a verdict is wrong or a bracket leaves out the limit.
ExitCode print_towers();

}  // namespace cupola
