#pragma once

#include <string>

#include "assembly/program/program.hpp"
#include "postproc/evaluated_run.hpp"

namespace cupola {

/// Inputs and options of `cupola-post analyse`.
struct AnalyseRequest {
  RunInput run;
  std::string output_folder;  ///< post/
  bool pictures = false;      ///< draw the standard views (Xvfb)
  bool tables_only = false;   ///< write no meshes, figures or report
  bool quiet = false;
};

/// Reads the run, evaluates it and writes the output folder (FORMAT.md lists its files).
///
/// Parts of the results that are missing or damaged are left out; the function then throws InputError at the
/// end, so that make does not take the folder for complete. Figures and pictures that cannot be drawn become
/// warnings in the report. If the run is not an equilibrium, the first lines of the report say so.
ExitCode analyse(const AnalyseRequest& request);

}  // namespace cupola
