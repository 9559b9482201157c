#pragma once

#include <optional>
#include <string>

#include "solver/analysis/analysis.hpp"

namespace cupola {

/// Everything that the solver asks of a type of analysis: one row of the table in analysis_table.cpp.
struct AnalysisTraits {
  AnalysisType type;
  bool steps_in_time;  ///< integrates a motion, which needs no fixed block
  bool many_states;    ///< steps, stages or equilibria: has a progress bar, and residuals of the worst state
  bool like_steps;     ///< of like cost, so that the first ones tell that of a run
  bool one_solve;      ///< one static solve, which passes its contacts on, and may be that of one sector
  const char* state;   ///< to which residuals belong, if not to the only one or the worst: " at ..."
  std::optional<Summary> (*run)(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);
  /// Static solves of the complete model, or work of the same time, on average.
  double (*num_solves)(const Case& scene, const Assembly& assembly);
  /// What `--explain` says: in one line, and lines for the features that only this analysis has.
  std::string (*describe)(const Case& scene);
  std::string (*features)(const Case& scene);
};

const AnalysisTraits& analysis_traits(AnalysisType type);

}  // namespace cupola
