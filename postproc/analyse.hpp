#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/program/program.hpp"

namespace cupola {

/// What `cupola-post analyse` is asked to do.
struct AnalyseRequest {
  Case scene;
  std::string assembly_path;   ///< assembly.vtu
  std::string results_folder;  ///< of cupola-solve
  std::string output_folder;   ///< post/
  std::string pvbatch;         ///< command that runs ParaView's pvbatch; "": no 3-D pictures
  bool tables_only = false;    ///< neither meshes nor figures nor a report: what other programs read
  bool quiet = false;
  bool force = false;  ///< take a run of another geometry, load, joint or analysis
};

/// Reads the run, evaluates it and writes the output folder (FORMAT.md lists its files). What is missing from
/// the results or damaged is left out, then InputError: make must not take the folder for complete. Figures
/// that gnuplot cannot draw become warnings in the report; a run that is not an equilibrium is said in its
/// first lines.
ExitCode analyse(const AnalyseRequest& request);

}  // namespace cupola
