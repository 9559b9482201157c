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
  /// The first part of the worst verdict, if it falls.
  std::optional<ScenePart> falling;
  StaticSolution motion;
};

/// Solves every part by itself, then those that stand together. None where contacts or ties connect all
/// blocks, or where the parts are more than a hundred: as many solves.
std::optional<StaticParts> solve_by_parts(const Model& model, const State& start, const ContactSet& contacts,
                                          const ContactMemories& memories, const StaticOptions& options);

/// Writes the verdicts into the summary. If the motion of a part is better proven than that of the whole, the
/// verdict and `frame` become those of this part, which decide for the whole. If the largest part stands,
/// the summary describes the equilibrium of all that do, and its frame is written. In `frame` they stop: the
/// solve of the whole shows their elastic displacements.
void add_parts(const StaticParts& parts, const Model& model, const StaticOptions& options, Summary* summary,
               Frame* frame, const AnalysisSinks& sinks);

}  // namespace cupola
