#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// The command line: cupola-post claims CLAIMS.yaml --runs FOLDER --output FOLDER
///
/// Evaluates the claims on finished runs, prints the table and writes claims.csv and claims.html. A claim
/// that is not reproduced is a result, not an error: the exit code is still `done`. With --needs the command
/// only prints the names of the runs that the claims and figures read.
ExitCode run_claims(int argc, const char* const* argv);

}  // namespace cupola
