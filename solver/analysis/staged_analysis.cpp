#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/pace.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/byte_archive.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/construction/construction_progress.hpp"
#include "solver/analysis/construction/stage_measures.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/runtime/ordered_loop.hpp"

namespace cupola {

namespace {

class ConstructionRun {
 public:
  ConstructionRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);
  std::optional<Summary> run();

 private:
  void resume();
  LaidBlocks foundation() const;
  void lay_foundation();
  bool may_go_on(const Construction& building);
  void advance();
  bool advance_at_once();
  void record(const Construction& building, const SolvedStage& stage);
  void summarize(const Construction& building, const SolvedStage& stage);
  bool is_due_for_frame() const;
  bool has_frame(const SolvedStage& stage) const;
  void save(const Construction& building);
  void write_tables() const;

  const Case& scene_;
  const StagedConstruction& staged_;
  const Assembly& assembly_;
  const AnalysisSinks& sinks_;
  Construction building_;
  std::vector<LaidBlocks> stages_;
  LeastSearch search_;
  ConstructionProgress progress_;
  Summary summary_;
  Pace saving_;
};

ConstructionRun::ConstructionRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks)
    : scene_(scene),
      staged_(scene.analysis.staged),
      assembly_(assembly),
      sinks_(sinks),
      building_(scene, assembly, sinks.log),
      stages_(laying_order(assembly, staged_)),
      search_(first_search(scene)) {
  if (stages_.empty())
    throw InputError(
        fmt::format("analysis.staged.first_ring = {}: no course is laid from there to {}; the model has the "
                    "rings 0 to {}, and two rings of an arch or barrel laid at once have the lower number",
                    staged_.first_ring,
                    staged_.last_ring < 0 ? "the top" : fmt::format("last_ring = {}", staged_.last_ring),
                    std::ranges::max(assembly.blocks, {}, &Block::ring).ring));
}

/// The courses below the first stage.
LaidBlocks ConstructionRun::foundation() const {
  LaidBlocks below{stages_.front().ring - 1, stages_.front().course - 1, 1.0, {}};
  for (size_t block = 0; block < assembly_.blocks.size(); ++block)
    if (!assembly_.blocks[block].fixed && building_.site().course[block] <= below.course)
      below.blocks.push_back(static_cast<int>(block));
  return below;
}

/// Lays the foundation as if built at once, with the mortar that it has in the first stage. If it does not
/// stand, it is a stage itself.
void ConstructionRun::lay_foundation() {
  LaidBlocks below = foundation();
  if (below.blocks.empty()) return;
  building_.lay(below.blocks, stages_.front().course);
  if (!building_.any_free()) return;
  SolvedStage stage;
  stage.solution = building_.solve(Construction::Need::forces);
  if (stage.solution.outcome == StaticOutcome::equilibrium) {
    if (staged_.carry) building_.accept(stage.solution);
    return;
  }
  stage.solution.message =
      "the courses below analysis.staged.first_ring, laid at once, do not stand: " + stage.solution.message;
  stage.least.bracket.sought.reason = "it is sought from analysis.staged.first_ring on";
  stage.iterations = stage.solution.iterations;
  if (stage.solution.outcome == StaticOutcome::moving)
    stage.falling = falling_blocks(building_.problem(), stage.solution.step_solution.v);
  stages_.insert(stages_.begin(), std::move(below));
  record(building_, stage);
  progress_.foundation_fell = true;
  progress_.ended = staged_.carry;
}

/// One stage, from what the last one left.
void ConstructionRun::advance() {
  const LaidBlocks& laid = stages_[progress_.next];
  building_.lay(laid.blocks, laid.course);
  // Where stages before it have failed, only the verdict of a stage without frame is shown.
  const bool shown = staged_.carry || is_due_for_frame() || progress_.first_failure.empty();
  SolvedStage stage =
      solve_stage(&building_, &search_, shown ? Construction::Need::forces : Construction::Need::verdict);
  record(building_, stage);
  if (!staged_.carry) {
    if (stage.solution.outcome == StaticOutcome::equilibrium) building_.accept(stage.solution);
    return;
  }
  // A stage that fails is built with the least mortar with which it stands, if that is known.
  if (stage.solution.outcome != StaticOutcome::equilibrium && stage.least.bracket.found)
    stage.solution = building_.solve_least(stage.least.bracket);
  progress_.ended = stage.solution.outcome != StaticOutcome::equilibrium;
  if (progress_.ended) return;
  progress_.include_displacement(building_, stage.solution);
  building_.accept(stage.solution);
}

/// Stages of whole courses without carried state, which do not know each other: each thread solves whole
/// ones, and they are recorded in their order beside that. False if the user wants to stop.
bool ConstructionRun::advance_at_once() {
  constexpr double kWork = 1e12;  // of all stages: always worth all threads
  struct Separate {
    Construction building;
    SolvedStage stage{};
    std::vector<std::string> log{};
  };
  const int first = progress_.next, left = static_cast<int>(stages_.size()) - first;
  std::vector<std::unique_ptr<Separate>> separate(left);
  std::mutex laying;
  int laid = 0;
  const auto lay = [&](int i) -> Separate& {
    const std::lock_guard lock(laying);
    for (; laid <= i; ++laid) {
      building_.lay(stages_[first + laid].blocks, stages_[first + laid].course);
      separate[laid] = std::make_unique<Separate>(Separate{building_});
      building_.suppose_standing();
    }
    return *separate[i];
  };
  const auto solve = [&](int i) {
    Separate& own = lay(i);
    if (num_threads() > 1) own.building.log_to([&own](const std::string& line) { own.log.push_back(line); });
    LeastSearch search = search_;
    own.stage = solve_stage(&own.building, &search, Construction::Need::forces);
  };
  const auto record_next = [&](int i) {
    const std::unique_ptr<Separate> own = std::move(separate[i]);
    for (const std::string& line : own->log) sinks_.log(line);
    record(own->building, own->stage);
    own->building.suppose_standing();  // as the next stage does
    return i + 1 == left || may_go_on(own->building);
  };
  return share_in_order(kWork, left, solve, record_next);
}

/// Of a long construction, every n-th stage has a frame, so that the frames of n blocks laid one by one take
/// a space proportional to n, and so has the last one.
bool ConstructionRun::is_due_for_frame() const {
  constexpr int kMost = 50;
  const int number = progress_.next, count = static_cast<int>(stages_.size());
  const int every = (count + kMost - 1) / kMost;
  return number % every == 0 || number + 1 == count;
}

/// So have the first stage that fails, and those with which the construction may end.
bool ConstructionRun::has_frame(const SolvedStage& stage) const {
  const bool may_end = staged_.carry && !stage.least.bracket.found;
  return is_due_for_frame() || (stage.solution.outcome != StaticOutcome::equilibrium &&
                                (may_end || progress_.first_failure.empty()));
}

/// Frame, and accuracy of the forces.
void ConstructionRun::summarize(const Construction& building, const SolvedStage& stage) {
  const LaidBlocks& laid = stages_[progress_.next];
  const StaticSolution& solution = stage.solution;
  const double time = laid.ring - 1 + laid.share;
  if (has_frame(stage)) {
    Frame frame = stage_frame(building, solution);
    frame.time = time;
    set_role(stage_role(solution.outcome), fmt::format("stage {}", progress_.next), &frame);
    sinks_.frame(frame);
    summarize_static(solution, frame, building.problem().model, building.options().tolerance, &summary_);
  } else {
    summarize_accuracy(solution, building.options().tolerance, &summary_);
  }
  progress_.worst.include(solution.residuals, summary_.certified_force_error, summary_.forces_unique,
                          violation_above(progress_.worst.violation, building, solution, time));
  if (!(summary_.accuracy.reached <= progress_.worst_balance))
    progress_.worst_balance = summary_.accuracy.reached;
}

void ConstructionRun::record(const Construction& building, const SolvedStage& stage) {
  const int number = progress_.next;
  const LaidBlocks& laid = stages_[number];
  summarize(building, stage);
  progress_.include(laid, building, stage);
  ++progress_.next;
  const std::string line =
      fmt::format("stage {:5d}  ring {:4d}  blocks {:6d}  {:<11}  |v|/(g h) {:9.2e}  {}", number, laid.ring,
                  building.problem().num_blocks, to_string(stage.solution.outcome),
                  stage.solution.speed_ratio, least_note(stage, staged_.least));
  sinks_.log(line);
  sinks_.progress(static_cast<double>(progress_.next) / static_cast<double>(stages_.size()), line);
}

void ConstructionRun::write_tables() const {
  if (progress_.solved > 0) sinks_.table("construction.csv", progress_.stages_csv);
  if (!progress_.failures_csv.empty()) sinks_.table("failures.csv", progress_.failures_csv);
}

void ConstructionRun::save(const Construction& building) {
  write_tables();
  ConstructionProgress progress = progress_;
  progress.last_bracket = search_.last();
  BuiltState state = building.state();
  ByteWriter archive;
  archive(progress, state);
  sinks_.checkpoint(archive.bytes());
}

void ConstructionRun::resume() {
  BuiltState state;
  ByteReader archive(sinks_.resume_from);
  archive(progress_, state);
  if (progress_.foundation_fell) stages_.insert(stages_.begin(), foundation());
  search_.start_from(progress_.last_bracket);
  building_.restore(std::move(state));
}

/// False if the user wants to stop. Saves from time to time, and then.
bool ConstructionRun::may_go_on(const Construction& building) {
  if (progress_.next == 0) return true;
  const bool interrupted = sinks_.interrupted();
  if (interrupted || saving_.is_due()) saving_.run([&] { save(building); });
  return !interrupted;
}

std::optional<Summary> ConstructionRun::run() {
  const double started = wall_seconds();
  const bool separate = staged_.unit == StagedConstruction::Unit::ring && !staged_.carry;
  if (!sinks_.resume_from.empty())
    resume();
  else
    lay_foundation();
  while (progress_.next < static_cast<int>(stages_.size()) && !progress_.ended) {
    if (!may_go_on(building_)) return std::nullopt;
    if (!separate)
      advance();
    else if (!advance_at_once())
      return std::nullopt;
  }
  write_tables();
  summary_.steps = progress_.solved;
  summary_.iterations = progress_.iterations;
  summary_.solve_time_seconds = wall_seconds() - started;
  progress_.worst.summarize(&summary_);
  summary_.accuracy.worst_over_run = progress_.worst_balance;
  progress_.judge(stages_, scene_, assembly_, &summary_);
  return summary_;
}

}  // namespace

std::optional<Summary> run_staged(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  return ConstructionRun(scene, assembly, sinks).run();
}

}  // namespace cupola
