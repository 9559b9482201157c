#pragma once

#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "solver/analysis/construction/construction.hpp"
#include "solver/analysis/construction/least_search.hpp"
#include "solver/dynamics/laying_order.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

enum class FallingMode { slides, tips };
constexpr auto enum_names(FallingMode) {
  return std::array{"slides", "tips"};
}

/// A block that leaves its place in a mechanism.
struct FallingBlock {
  int block = 0;
  /// tips: it turns about an axis no farther than its farthest corner, or hinges faster than it slides, together
  /// with blocks that move with it as one.
  FallingMode mode = FallingMode::slides;
  double speed = 0.0;  ///< of its centroid, over that of the fastest block
};

/// The blocks whose centroids move at a tenth of the largest speed or more. `v`: velocities of the free
/// blocks (6 nb), of any amplitude.
std::vector<FallingBlock> falling_blocks(const StageProblem& problem, const VecX& v);

/// A stage that was solved.
struct SolvedStage {
  StaticSolution solution;            ///< with the mortar of the case
  LeastSearch::Result least;          ///< of the property of fresh mortar that is sought
  std::vector<FallingBlock> falling;  ///< in it or, if it stands, in the trial that moves nearest to `least`
  int iterations = 0;                 ///< of all its solves
};

/// Solves the stage that is laid. `search`: for the property that analysis.staged.least names.
SolvedStage solve_stage(Construction* building, LeastSearch* search, Construction::Need need);

/// The search of the first stage.
LeastSearch first_search(const Case& scene);

// Rows of construction.csv and failures.csv, with the ends of their lines.
std::string construction_header();
std::string failures_header();
std::string construction_row(int number, const LaidBlocks& laid, const Construction& building,
                             const SolvedStage& stage);
std::string failure_rows(int number, const LaidBlocks& laid, const Assembly& assembly,
                         const SolvedStage& stage);
/// How the search ended, or nothing.
std::string least_note(const SolvedStage& stage, StagedConstruction::Least property);

}  // namespace cupola
