#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/program/program.hpp"

namespace cupola {

/// Inputs and options of `cupola-post analyse`.
struct AnalyseRequest {
  Case scene;
  std::string assembly_path;   ///< assembly.vtu
  std::string results_folder;  ///< written by cupola-solve
  std::string output_folder;   ///< post/
  std::string pvbatch;         ///< command that runs ParaView's pvbatch; "": no 3-D pictures
  bool tables_only = false;    ///< write no meshes, figures or report
  bool quiet = false;
  bool strict = false;  ///< warnings about the case and the blocks are errors
  bool force = false;   ///< accept a run whose geometry, loads, joints or analysis differ from the case
};

/// Reads the run, evaluates it and writes the output folder (FORMAT.md lists its files).
///
/// Parts of the results that are missing or damaged are left out; the function then throws InputError at the
/// end, so that make does not take the folder for complete. Figures that gnuplot cannot draw become warnings
/// in the report. If the run is not an equilibrium, the first lines of the report say so.
ExitCode analyse(const AnalyseRequest& request);

}  // namespace cupola
