#include "solver/analysis/construction/construction_progress.hpp"

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/model/block_names.hpp"
#include "solver/analysis/statics/static_record.hpp"

namespace cupola {
namespace {

using Least = StagedConstruction::Least;

/// "stage 3 in course 20 (block c20-7)".
std::string stage_name(int number, const LaidBlocks& laid, const Assembly& assembly) {
  return fmt::format("stage {} in course {} (block {})", number, laid.ring,
                     block_label(assembly, laid.blocks.front()));
}

/// What the searches for the least property have shown, as the end of a message.
std::string least_message(const ConstructionProgress& p, Least property) {
  const std::string name = to_string(property);
  std::string message =
      fmt::format("; {} without fresh {}", counted(p.need_none, "stage stands", "stages stand"), name);
  if (p.undecided > 0)
    message += fmt::format("; the least fresh {} of {} is not known to the width asked for", name,
                           counted(p.undecided, "stage"));
  return message;
}

}  // namespace

void ConstructionProgress::include(const LaidBlocks& laid, const Construction& building,
                                   const SolvedStage& stage) {
  const BuildingSite& site = building.site();
  const StaticSolution& solution = stage.solution;
  const bool stands = solution.outcome == StaticOutcome::equilibrium;
  ++solved;
  iterations += stage.iterations;
  standing += stands;
  need_none += stage.least.needs_none;
  unconverged = unconverged || solution.outcome == StaticOutcome::unconverged;
  all_proven = all_proven && solution.proven;
  motion_proven = motion_proven || (solution.outcome == StaticOutcome::moving && solution.proven);
  if (!stands && first_failure.empty())
    first_failure = stage_name(next, laid, site.assembly) + ": " + solution.message;
  const bool seeks = site.scene.analysis.staged.least != Least::none;
  undecided += seeks && !stage.least.needs_none && !stage.least.bracket.narrow;
  if (stage.least.bracket.found && stage.least.bracket.stable.value > least_stands) {
    least_stands = stage.least.bracket.stable.value;
    least_moves = stage.least.bracket.moving.value;
    least_stage = next;
  }
  stages_csv += construction_row(next, laid, building, stage);
  if (stage.falling.empty()) return;
  if (failures_csv.empty()) failures_csv = failures_header();
  failures_csv += failure_rows(next, laid, site.assembly, stage);
}

void ConstructionProgress::judge(const std::vector<LaidBlocks>& stages, const Case& scene,
                                 const Assembly& assembly, Summary* summary) const {
  const auto total = static_cast<int>(stages.size());
  const Least property = scene.analysis.staged.least;
  summary->status = unconverged         ? Status::unconverged
                    : standing == total ? cupola::standing(all_proven)
                                        : motion(motion_proven);
  summary->message = fmt::format("stages that stand with the mortar of the case: {} of {}", standing, solved);
  if (!first_failure.empty()) summary->message += "; the first that does not is " + first_failure;
  if (ended)
    summary->message +=
        fmt::format("; the construction ends there, {} were not reached", counted(total - solved, "stage"));
  if (property == Least::none) return;
  summary->message += least_message(*this, property);
  if (least_stands < 0.0) return;
  summary->critical = CriticalValue{"fresh " + std::string(to_string(property)),
                                    0.5 * (least_stands + least_moves), least_stands, least_moves};
  summary->message += fmt::format("; the most demanding is {}, which needs {:.4g}{}",
                                  stage_name(least_stage, stages[least_stage], assembly), least_stands,
                                  property == Least::cohesion ? " Pa" : "");
}

}  // namespace cupola
