#pragma once

#include <string>

#include "assembly/case/case.hpp"
#include "assembly/program/program.hpp"

namespace cupola {

/// What the user asks of one run of cupola-solve.
struct SolveRequest {
  Case scene;
  std::string assembly_path;
  std::string output_folder;
  std::string dump_fclib;  ///< file for the contact problem of the static solve or the last step; empty: none
  bool quiet = false;
  bool force = false;   ///< take an assembly that was made from another geometry or material
  int threads = 1;      ///< >= 1
  bool resume = false;  ///< go on from the checkpoint in the output folder, if there is one
};

/// Reads the assembly, checks that it was made from this case, runs the analysis and writes the results
/// folder: frames as they come, history.csv, run.yaml, and summary.json last, so that a folder with a summary
/// is complete. Returns `accuracy_not_reached` when the analysis did not converge. Throws InputError and
/// SystemError.
ExitCode solve_case(const SolveRequest& request);

/// The model that would be solved: bodies, unknowns, contacts, active features and why (`--explain`).
std::string explain_case(const SolveRequest& request);

}  // namespace cupola
