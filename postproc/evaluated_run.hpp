#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The files of a finished run.
struct RunInput {
  Case scene;
  std::string assembly_path;   ///< assembly.vtu
  std::string results_folder;  ///< written by cupola-solve
  bool strict = false;         ///< warnings about the case and the blocks are errors
  bool force = false;  ///< accept a run whose geometry, loads, joints or analysis differ from the case
};

struct EvaluatedRun {
  ResultsReader results;
  Evaluation evaluation;
  std::vector<std::string> doubts;  ///< about the case and the blocks; printed by evaluate_run()
};

/// Reads and evaluates a run, and prints the warnings about its case and blocks. Throws InputError if the
/// assembly or the results belong to another case, unless `force` is set.
EvaluatedRun evaluate_run(const RunInput& input);

}  // namespace cupola
