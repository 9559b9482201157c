#include "solver/analysis/construction/construction_progress.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/laying_course.hpp"
#include "solver/analysis/construction/stage_measures.hpp"
#include "solver/analysis/statics/static_record.hpp"

namespace cupola {
namespace {

using Least = StagedConstruction::Least;

/// "stage 3 in course 20 (block c20-7)": of several courses laid at once, the last.
std::string stage_name(int number, const LaidBlocks& laid, const Assembly& assembly) {
  const int first_of_last = *std::ranges::max_element(
      laid.blocks, {}, [&](int block) { return laying_course(assembly, assembly.blocks[block]); });
  return fmt::format("stage {} in course {} (block {})", number, laid.ring,
                     block_label(assembly, first_of_last));
}

/// "no fresh cohesion up to 1 MPa holds stage 3 in course 3 (block 8)"; `tried`: the largest value.
std::string not_held_text(Least property, double tried, const std::string& stage) {
  const std::string most =
      property == Least::cohesion ? fmt::format("{:g} MPa", 1e-6 * tried) : fmt::format("{:g}", tried);
  return fmt::format("no fresh {} up to {} holds {}", to_string(property), most, stage);
}

/// Of a stage whose search found no value, or not the least.
Sought answer_of_stage(const Bracket& bracket, Least property, const std::string& stage) {
  const bool moves = bracket.moving.outcome == StaticOutcome::moving;
  return {.found = moves ? "none" : "unknown",
          .reason = moves ? not_held_text(property, bracket.moving.value, stage)
                          : fmt::format("the least fresh {} of {} was not found ({})", to_string(property),
                                        stage, bracket.sought.reason)};
}

/// The answer to analysis.staged.least, the last clause of the message. A value that not all stages have is
/// none of the construction: a stage may hide what it needs.
Sought least_answer(const ConstructionProgress& p, Least property, const std::string& most_demanding) {
  if (!p.not_held.reason.empty()) return p.not_held;
  if (p.may_need > p.least_stands) return p.may_need_more;
  if (p.least_stands < 0.0)
    return {.found = "0", .reason = fmt::format("every stage stands without fresh {}", to_string(property))};
  return {.reason = fmt::format("the most demanding is {}, which needs {:.4g}{}", most_demanding,
                                p.least_stands, property == Least::cohesion ? " Pa" : "")};
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
  if (stands) include_displacement(building, solution);
  need_none += stage.least.needs_none;
  unconverged = unconverged || solution.outcome == StaticOutcome::unconverged;
  all_proven = all_proven && solution.proven;
  motion_proven = motion_proven || (solution.outcome == StaticOutcome::moving && solution.proven);
  if (!stands && first_failure.empty())
    first_failure = stage_name(next, laid, site.assembly) + ": " + solution.message;
  const Least property = site.scene.analysis.staged.least;
  const Bracket& bracket = stage.least.bracket;
  if (property != Least::none && !stage.least.needs_none) {
    undecided += bracket.found && !bracket.narrow;
    if (!bracket.found) {
      Sought answer = answer_of_stage(bracket, property, stage_name(next, laid, site.assembly));
      if (bracket.stable.outcome != StaticOutcome::equilibrium) {
        if (not_held.reason.empty()) not_held = std::move(answer);
      } else if (bracket.stable.value > may_need) {
        may_need = bracket.stable.value;
        may_need_more = std::move(answer);
      }
    }
  }
  if (bracket.found && bracket.stable.value > least_stands) {
    least_stands = bracket.stable.value;
    least_moves = bracket.moving.value;
    least_stage = next;
  }
  stages_csv += construction_row(next, laid, building, stage);
  if (stage.falling.empty()) return;
  if (failures_csv.empty()) failures_csv = failures_header();
  failures_csv += failure_rows(next, laid, site.assembly, stage);
}

void ConstructionProgress::include_displacement(const Construction& building,
                                                const StaticSolution& solution) {
  largest_displacement = std::max(largest_displacement, cupola::largest_displacement(building, solution));
}

void ConstructionProgress::judge(const std::vector<LaidBlocks>& stages, const Case& scene,
                                 const Assembly& assembly, Summary* summary) const {
  const auto total = static_cast<int>(stages.size());
  const Least property = scene.analysis.staged.least;
  summary->status = motion_proven       ? Status::moving
                    : unconverged       ? Status::unconverged
                    : standing == total ? cupola::standing(all_proven)
                                        : Status::moving_unproven;
  summary->message = fmt::format("stages that stand with the mortar of the case: {} of {}", standing, solved);
  if (!first_failure.empty()) summary->message += "; the first that does not is " + first_failure;
  if (ended && solved < total)
    summary->message += fmt::format("; the construction ends at stage {}, {} not reached", next - 1,
                                    counted(total - solved, "stage was", "stages were"));
  warn_of_large_displacement(scene, assembly, largest_displacement, &summary->warnings);
  if (property == Least::none) return;
  const std::string name = to_string(property);
  summary->message +=
      fmt::format("; {} without fresh {}", counted(need_none, "stage stands", "stages stand"), name);
  if (undecided > 0)
    summary->message += fmt::format("; the least fresh {} of {} is not known to the width asked for", name,
                                    counted(undecided, "stage"));
  summary->sought = least_answer(*this, property, stage_name(least_stage, stages[least_stage], assembly));
  summary->sought->quantity = "critical fresh " + name;
  add_clause(clauses(*summary->sought), &summary->message);
  if (summary->sought->found.empty())
    summary->critical =
        CriticalValue{"fresh " + name, 0.5 * (least_stands + least_moves), least_stands, least_moves};
}

}  // namespace cupola
