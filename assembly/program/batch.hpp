#pragma once

#include <functional>
#include <string_view>

#include "assembly/program/program.hpp"

namespace cupola {

/// Reads a command line and returns the run that it asks for. What later runs can use again is computed here.
using PreparedRun = std::function<ExitCode()>;
using Prepare = std::function<PreparedRun(int argc, char** argv)>;

/// run_program() for the run of a command line; with `--batch FILE` for each run of a list. A line of the
/// list is
///
///     STAMP NEEDED ARGUMENTS...
///
/// separated by blanks: the run is left out unless the file NEEDED exists, `-` for none. It is a process of
/// its own, forked after `prepare`, so that it cannot change or end the others, and printed before it starts.
/// Its error goes to stderr and to errors.txt beside STAMP, and its exit code to STAMP if it is 0 or 3. The
/// exit code is that of the first run that failed.
int run_program(std::string_view name, int argc, char** argv, const Prepare& prepare);

}  // namespace cupola
