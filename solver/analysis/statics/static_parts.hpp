#pragma once

#include <optional>
#include <vector>

#include "solver/analysis/record/analysis_sinks.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "solver/dynamics/islands.hpp"

namespace cupola {

/// The verdicts of the parts of a structure that no contact or tie connects, so that a loose stone does not
/// decide that of the rest.
struct StaticParts {
  std::vector<PartVerdict> verdicts;  ///< the largest part first
  std::vector<char> stands;           ///< 1 or 0 (num_free)
  /// All parts that stand, if the largest does, and their equilibrium.
  std::optional<ScenePart> standing;
  StaticSolution solution;
};

/// Solves every part by itself, then those that stand together. None where contacts or ties connect all
/// blocks, or where the parts are more than a hundred: as many solves.
std::optional<StaticParts> solve_by_parts(const Model& model, const State& start, const ContactSet& contacts,
                                          const ContactMemories& memories, const StaticOptions& options);

/// Writes the verdicts into the summary, whose status becomes that of the worst part. If the largest part
/// stands, the summary describes the equilibrium of all that do, and its frame is written.
void add_parts(const StaticParts& parts, const StaticOptions& options, Summary* summary,
               const AnalysisSinks& sinks);

/// Stops what stands in the frame of a motion of the whole: the solve shows the elastic displacements there.
void stop_what_stands(const StaticParts& parts, const Model& model, Frame* frame);

}  // namespace cupola
