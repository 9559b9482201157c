#pragma once

#include <string>

#include "assembly/program/program.hpp"

namespace cupola {

/// Solves a problem of the frictional contact library (`cupola-solve --fclib FILE`) under Coulomb's law.
/// Prints its size, the ending of the solve, FCLIB's merit and the scaled residual, and writes the problem in
/// the local form with its solution to `output`, unless that is empty. Returns `accuracy_not_reached` if the solve did
/// not converge.
ExitCode solve_fclib(const std::string& path, const std::string& output, bool quiet);

}  // namespace cupola
