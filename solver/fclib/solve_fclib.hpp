#pragma once

#include <string>

#include "assembly/program/program.hpp"

namespace cupola {

/// Solves a problem of the frictional contact library (`cupola-solve --fclib FILE`) under Coulomb's law and
/// prints its size, how the solve ended, FCLIB's own merit and ours. Returns `accuracy_not_reached` when it
/// did not converge.
ExitCode solve_fclib(const std::string& path, bool quiet);

}  // namespace cupola
