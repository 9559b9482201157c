#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// `cupola-post claims CLAIMS.yaml --runs FOLDER --output FOLDER`: evaluates the claims on finished runs,
/// prints the table and writes claims.csv and claims.html. A claim that fails is a result: the command ends
/// with `done`. With --needs it prints the names of the runs that the claims read, and stops.
ExitCode run_claims(int argc, const char* const* argv);

}  // namespace cupola
