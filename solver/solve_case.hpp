#pragma once

#include <string>

#include "assembly/case/case.hpp"
#include "assembly/program/program.hpp"

namespace cupola {

/// Input of one run of cupola-solve.
struct SolveRequest {
  Case scene;
  std::string assembly_path;
  std::string output_folder;
  bool quiet = false;
  bool verbose = false;  ///< print every step, and all residuals at the end
  bool strict = false;   ///< warnings are errors
  bool force = false;    ///< use an assembly that was made from another geometry or material
  int threads = 1;       ///< >= 1
  bool resume = false;   ///< resume from the checkpoint in the output folder, if there is one
};

/// Reads the assembly, checks that it was made from this case, runs the analysis and writes the results
/// folder. Frames are written as they are computed and summary.json last, so that a folder with a summary is
/// complete. Returns `accuracy_not_reached` if the analysis did not converge and `interrupted` if the user
/// stopped it. Throws InputError and SystemError.
ExitCode solve_case(SolveRequest request);

/// Text of `--explain`: blocks, unknowns, contacts, active features and estimated cost.
std::string explain_case(SolveRequest request);

}  // namespace cupola
