#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/analysis/construction/solved_stage.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/record/record_archive.hpp"
#include "solver/dynamics/state_archive.hpp"

namespace cupola {

/// What the stages of a construction so far have shown.
struct ConstructionProgress {
  int next = 0;  ///< stage
  int solved = 0, standing = 0, need_none = 0, undecided = 0, iterations = 0;
  double worst_balance = 0.0;
  double largest_displacement = 0.0;  ///< m, of a block in a stage that stands or is carried on
  WorstOfRun worst;
  double least_stands = -1.0, least_moves = 0.0;  ///< of the most demanding stage; < 0: none found
  int least_stage = 0;
  Sought not_held;         ///< of the first stage for which the search found no value; no reason: none
  double may_need = -1.0;  ///< most that a stage needs of which only that value is known; < 0: there is none
  Sought may_need_more;    ///< of that stage
  std::optional<std::pair<double, double>> last_bracket;  ///< of the search
  std::string first_failure;  ///< stage and message of the first one that does not stand
  bool unconverged = false, ended = false;
  bool foundation_fell = false;                   ///< the courses below first_ring, a stage of their own
  bool all_proven = true, motion_proven = false;  ///< one motion is enough to refute the construction
  std::string stages_csv = construction_header(), failures_csv;

  /// Counts stage `next`.
  void include(const LaidBlocks& laid, const Construction& building, const SolvedStage& stage);
  /// Of an equilibrium from which the next stage starts.
  void include_displacement(const Construction& building, const StaticSolution& solution);
  /// Sets status, message and critical value of the whole construction.
  void judge(const std::vector<LaidBlocks>& stages, const Case& scene, const Assembly& assembly,
             Summary* summary) const;
};

// For checkpoints.

template <class Archive>
void visit(Archive& archive, BuiltContact& x) {
  archive(x.memory, x.gap, x.hardened);
}
template <class Archive>
void visit(Archive& archive, CarriedTie& x) {
  archive(x.memory, x.loosening);
}
template <class Archive>
void visit(Archive& archive, BuiltState& x) {
  archive(x.ring, x.laid, x.fresh, x.displacement, x.rotation, x.joints, x.ties);
}

template <class Archive>
void visit(Archive& archive, ConstructionProgress& x) {
  archive(x.next, x.solved, x.standing, x.need_none, x.undecided, x.iterations, x.worst_balance,
          x.largest_displacement, x.worst, x.least_stands, x.least_moves, x.least_stage, x.not_held,
          x.may_need, x.may_need_more, x.last_bracket, x.first_failure, x.unconverged, x.ended,
          x.foundation_fell, x.all_proven, x.motion_proven, x.stages_csv, x.failures_csv);
}

}  // namespace cupola
