#pragma once

#include <string>

#include "assembly/program/program.hpp"
#include "postproc/evaluated_run.hpp"

namespace cupola {

/// Writes the blocks and the joint forces of a run for another program; the ending of `path` chooses the
/// format. A .csv file holds the table of the joints. In a dynamic analysis and a path the blocks stand where
/// they are at the instant evaluated, otherwise as built. Forces are left out, with a warning, if the run is
/// not an equilibrium.
ExitCode export_run(const RunInput& input, const std::string& path, bool quiet);

}  // namespace cupola
