#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/pace.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/byte_archive.hpp"
#include "assembly/files/csv_columns.hpp"
#include "assembly/model/block_names.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/construction/construction.hpp"
#include "solver/analysis/construction/falling_blocks.hpp"
#include "solver/analysis/construction/least_search.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/record/record_archive.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/dynamics/memory_archive.hpp"

namespace cupola {

namespace {

/// A stage with its static solve: a row of construction.csv.
struct StageRow {
  int number;
  const LaidBlocks& stage;
  int free_blocks;
  const StaticSolution& solution;
  const LeastSearch::Result& least;
  std::string note;
  std::optional<double> head_squeeze = std::nullopt,
                        displacement = std::nullopt;  // m, of a stage that stands
};

std::string metres(const std::optional<double>& length) {
  return length ? fmt::format("{:.6e}", *length) : "";
}

constexpr CsvColumn<StageRow> kConstructionColumns[] = {
    {"stage", [](const StageRow& r) { return std::to_string(r.number); }},
    {"ring", [](const StageRow& r) { return std::to_string(r.stage.ring); }},
    {"laid", [](const StageRow& r) { return std::to_string(r.stage.blocks.size()); }},
    {"blocks", [](const StageRow& r) { return std::to_string(r.free_blocks); }},
    {"verdict", [](const StageRow& r) { return to_string(r.solution.outcome); }},
    {"speed_ratio", [](const StageRow& r) { return fmt::format("{:.6e}", r.solution.speed_ratio); }},
    {"least_stands",
     [](const StageRow& r) -> std::string {
       if (r.least.bracket.found) return fmt::format("{:.9g}", r.least.bracket.stable.value);
       return r.least.needs_none ? "0" : "";
     }},
    {"least_moves",
     [](const StageRow& r) {
       return r.least.bracket.found ? fmt::format("{:.9g}", r.least.bracket.moving.value) : "";
     }},
    {"head_squeeze_m", [](const StageRow& r) { return metres(r.head_squeeze); }},
    {"displacement_m", [](const StageRow& r) { return metres(r.displacement); }},
    {"note", [](const StageRow& r) { return r.note; }},
};

/// A block that leaves its place in a stage: a row of failures.csv.
struct FailureRow {
  int stage, ring;
  const Assembly& assembly;
  const FallingBlock& falling;
};

constexpr CsvColumn<FailureRow> kFailureColumns[] = {
    {"stage", [](const FailureRow& r) { return std::to_string(r.stage); }},
    {"ring", [](const FailureRow& r) { return std::to_string(r.ring); }},
    {"block", [](const FailureRow& r) { return block_label(r.assembly, r.falling.block); }},
    {"course", [](const FailureRow& r) { return std::to_string(r.assembly.blocks[r.falling.block].ring); }},
    {"how", [](const FailureRow& r) { return to_string(r.falling.mode); }},
    {"relative_speed", [](const FailureRow& r) { return fmt::format("{:.4f}", r.falling.speed); }},
};

}  // namespace

/// What the stages so far have shown.
struct ConstructionProgress {
  int next = 0;  // stage
  int ring = 0;  // youngest course
  int solved = 0, standing = 0, need_none = 0, undecided = 0, iterations = 0;
  double worst_balance = 0.0;
  WorstOfRun worst;
  double least_stands = -1.0, least_moves = 0.0;  // of the most demanding stage; < 0: none found
  int least_stage = 0;
  std::optional<std::pair<double, double>> last_bracket;  // of the search
  std::string first_failure;  // stage and message of the first one that does not stand
  bool unconverged = false, ended = false, failed = false;
  bool all_proven = true, motion_proven = false;  // one motion is enough to refute the construction
  std::string stages_csv, failures_csv;
};

template <class Archive>
void visit(Archive& archive, ConstructionProgress& x) {
  archive(x.next, x.ring, x.solved, x.standing, x.need_none, x.undecided, x.iterations, x.worst_balance,
          x.worst, x.least_stands, x.least_moves, x.least_stage, x.last_bracket, x.first_failure,
          x.unconverged, x.ended, x.failed, x.all_proven, x.motion_proven, x.stages_csv, x.failures_csv);
}
template <class Archive>
void visit(Archive& archive, BuiltContact& x) {
  archive(x.memory, x.gap, x.hardened);
}
template <class Archive>
void visit(Archive& archive, BuiltState& x) {
  archive(x.laid, x.displacement, x.rotation, x.joints);
}

namespace {

/// Largest values and narrowest brackets of the search for the least property.
constexpr double kMostCohesion = 1e6, kNarrowestCohesion = 0.1;  // Pa
constexpr double kMostFriction = 10.0, kNarrowestFriction = 1e-4;
constexpr double kFirstCohesion = 1000.0, kFirstFriction = 0.5;  // tried first

LeastSearch search_of(const StagedConstruction& staged) {
  if (staged.least == StagedConstruction::Least::friction)
    return {kFirstFriction, kMostFriction, {staged.relative_width, kNarrowestFriction}};
  return {kFirstCohesion, kMostCohesion, {staged.relative_width, kNarrowestCohesion}};
}

class ConstructionRun {
 public:
  ConstructionRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);
  std::optional<Summary> run();

 private:
  bool lay_foundation();
  bool advance();
  LeastSearch::Result find_least();
  void record(const LaidBlocks& stage, const StaticSolution& solution, const LeastSearch::Result& least);
  void record_failure(const LaidBlocks& stage, const std::vector<FallingBlock>& falling);
  bool has_frame(int stage, bool stands, bool may_end) const;
  std::string checkpoint() const;
  void save();
  void write_tables() const;
  void judge();

  const StagedConstruction& staged_;
  const Assembly& assembly_;
  const AnalysisSinks& sinks_;
  Construction building_;
  std::vector<LaidBlocks> stages_;
  LeastSearch search_;
  ConstructionProgress progress_;
  std::vector<FallingBlock> falling_;  // in the failing trial of the search nearest to the least value
  Summary summary_;
  Pace saving_;
};

ConstructionRun::ConstructionRun(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks)
    : staged_(scene.analysis.staged),
      assembly_(assembly),
      sinks_(sinks),
      building_(scene, assembly, sinks.log),
      search_(search_of(staged_)) {
  int top = 0;
  for (const Block& block : assembly.blocks) top = std::max(top, block.ring);
  const int last = staged_.last_ring < 0 ? top : std::min(staged_.last_ring, top);
  if (staged_.first_ring > last)
    throw InputError(fmt::format("analysis.staged.first_ring = {}: must not exceed the last ring, {}",
                                 staged_.first_ring, last));
  stages_ = laying_order(assembly, staged_, staged_.first_ring, last);
  progress_.stages_csv = csv_header(kConstructionColumns) + "\n";
  progress_.failures_csv = csv_header(kFailureColumns) + "\n";
}

/// The courses below the first stage, as if built at once, with the mortar that they have in that stage.
/// False if they do not stand.
bool ConstructionRun::lay_foundation() {
  std::vector<int> below;
  for (size_t block = 0; block < assembly_.blocks.size(); ++block)
    if (!assembly_.blocks[block].fixed && assembly_.blocks[block].ring < staged_.first_ring)
      below.push_back(static_cast<int>(block));
  if (below.empty()) return true;
  building_.lay(below, staged_.first_ring);
  if (!staged_.carry || !building_.any_free()) return true;
  const StaticSolution solution = building_.solve();
  const Frame frame = building_.frame(solution);
  summarize_static(solution, frame, building_.problem().model, building_.options().tolerance, &summary_);
  if (solution.outcome == StaticOutcome::equilibrium) {
    building_.accept(solution);
    return true;
  }
  sinks_.frame(frame);
  summary_.message = "the courses below analysis.staged.first_ring do not stand: " + summary_.message;
  return false;
}

LeastSearch::Result ConstructionRun::find_least() {
  falling_.clear();
  double nearest = -1.0;
  return search_.find([&](double value) -> std::optional<LimitTrial> {
    const StaticSolution solution = building_.solve(value);
    progress_.iterations += solution.iterations;
    if (solution.outcome == StaticOutcome::moving && value > nearest) {
      nearest = value;
      falling_ = falling_blocks(building_.problem().model, solution.step_solution.v);
    }
    return LimitTrial{value, solution.outcome, solution.speed_ratio};
  });
}

/// One stage. False if the construction ends there.
bool ConstructionRun::advance() {
  const LaidBlocks& stage = stages_[progress_.next];
  building_.lay(stage.blocks, stage.ring);
  LeastSearch::Result least;
  const bool seeks = staged_.least != StagedConstruction::Least::none;
  if (seeks) least = find_least();
  StaticSolution solution = building_.solve();
  progress_.iterations += solution.iterations;
  if (solution.outcome == StaticOutcome::moving)
    falling_ = falling_blocks(building_.problem().model, solution.step_solution.v);
  record(stage, solution, least);
  if (!falling_.empty()) record_failure(stage, falling_);
  falling_.clear();
  ++progress_.next;
  progress_.ring = stage.ring;
  // A stage that fails is built with the least mortar with which it stands, if that is known.
  if (solution.outcome != StaticOutcome::equilibrium && least.bracket.found)
    solution = building_.solve(least.bracket.stable.value);
  if (solution.outcome == StaticOutcome::equilibrium) {
    building_.accept(solution);
    return true;
  }
  progress_.ended = staged_.carry;
  return !progress_.ended;
}

std::string least_note(const LeastSearch::Result& least, StagedConstruction::Least property) {
  if (property == StagedConstruction::Least::none) return "";
  return least.needs_none ? fmt::format("stands without {}", to_string(property)) : least.bracket.message;
}

/// Of a long construction, every n-th stage has a frame, so that the frames of n blocks laid one by one take
/// a space proportional to n, and so have the first stage that fails, those with which the construction may
/// end, and the last one.
bool ConstructionRun::has_frame(int stage, bool stands, bool may_end) const {
  constexpr int kMost = 100;
  const int count = static_cast<int>(stages_.size()), every = (count + kMost - 1) / kMost;
  return stage % every == 0 || stage + 1 == count ||
         (!stands && (may_end || progress_.first_failure.empty()));
}

void ConstructionRun::record(const LaidBlocks& stage, const StaticSolution& solution,
                             const LeastSearch::Result& least) {
  const int number = progress_.next;
  const double time = stage.ring - 1 + stage.share;
  const bool stands = solution.outcome == StaticOutcome::equilibrium;
  const bool framed = has_frame(number, stands, staged_.carry && !least.bracket.found);
  if (framed || !stands) {
    Frame frame = building_.frame(solution);
    frame.time = time;
    set_role(stage_role(solution.outcome), fmt::format("stage {}", number), &frame);
    if (framed) sinks_.frame(frame);
    summarize_static(solution, frame, building_.problem().model, building_.options().tolerance, &summary_);
  } else {
    summarize_accuracy(solution, building_.options().tolerance, &summary_);
  }
  progress_.worst.include(solution.residuals, summary_.certified_force_error, summary_.forces_unique,
                          building_.violation_above(progress_.worst.violation, solution, time));
  if (!(summary_.accuracy.reached <= progress_.worst_balance))
    progress_.worst_balance = summary_.accuracy.reached;

  ++progress_.solved;
  progress_.standing += stands;
  progress_.need_none += least.needs_none;
  progress_.unconverged = progress_.unconverged || solution.outcome == StaticOutcome::unconverged;
  progress_.all_proven = progress_.all_proven && solution.proven;
  progress_.motion_proven =
      progress_.motion_proven || (solution.outcome == StaticOutcome::moving && solution.proven);
  if (!stands && progress_.first_failure.empty())
    progress_.first_failure = fmt::format("stage {} in course {} (block {}): {}", number, stage.ring,
                                          block_label(assembly_, stage.blocks.front()), solution.message);
  const bool seeks = staged_.least != StagedConstruction::Least::none;
  progress_.undecided += seeks && !least.needs_none && !least.bracket.narrow;
  if (least.bracket.found && least.bracket.stable.value > progress_.least_stands) {
    progress_.least_stands = least.bracket.stable.value;
    progress_.least_moves = least.bracket.moving.value;
    progress_.least_stage = number;
  }
  StageRow row{.number = number,
               .stage = stage,
               .free_blocks = building_.problem().model.num_free(),
               .solution = solution,
               .least = least,
               .note = least_note(least, staged_.least)};
  if (stands) {
    row.head_squeeze = building_.head_squeeze(solution);
    row.displacement = building_.displacement(solution);
  }
  progress_.stages_csv += csv_row(kConstructionColumns, row) + "\n";
  const std::string line =
      fmt::format("stage {:5d}  ring {:4d}  blocks {:6d}  {:<11}  |v|/(g h) {:9.2e}  {}", number, stage.ring,
                  row.free_blocks, to_string(solution.outcome), solution.speed_ratio, row.note);
  sinks_.log(line);
  sinks_.progress(static_cast<double>(number + 1) / static_cast<double>(stages_.size()), line);
}

void ConstructionRun::record_failure(const LaidBlocks& stage, const std::vector<FallingBlock>& falling) {
  progress_.failed = true;
  for (const FallingBlock& block : falling)
    progress_.failures_csv +=
        csv_row(kFailureColumns, FailureRow{progress_.next, stage.ring, assembly_, block}) + "\n";
}

void ConstructionRun::write_tables() const {
  if (progress_.solved > 0) sinks_.table("construction.csv", progress_.stages_csv);
  if (progress_.failed) sinks_.table("failures.csv", progress_.failures_csv);
}

void ConstructionRun::judge() {
  const ConstructionProgress& p = progress_;
  const auto total = static_cast<int>(stages_.size());
  summary_.status = p.unconverged         ? Status::unconverged
                    : p.standing == total ? standing(p.all_proven)
                                          : motion(p.motion_proven);
  summary_.message =
      fmt::format("stages that stand with the mortar of the case: {} of {}", p.standing, p.solved);
  if (!p.first_failure.empty()) summary_.message += "; the first that does not is " + p.first_failure;
  if (p.ended)
    summary_.message +=
        fmt::format("; the construction ends there, {} were not reached", counted(total - p.solved, "stage"));
  if (staged_.least == StagedConstruction::Least::none) return;
  const std::string property = to_string(staged_.least);
  summary_.message +=
      fmt::format("; {} without fresh {}", counted(p.need_none, "stage stands", "stages stand"), property);
  if (p.undecided > 0)
    summary_.message += fmt::format("; the least fresh {} of {} is not known to the width asked for",
                                    property, counted(p.undecided, "stage"));
  if (p.least_stands < 0.0) return;
  const std::string parameter = "fresh " + property;
  summary_.critical =
      CriticalValue{parameter, 0.5 * (p.least_stands + p.least_moves), p.least_stands, p.least_moves};
  const LaidBlocks& stage = stages_[p.least_stage];
  summary_.message +=
      fmt::format("; the most demanding is stage {} in course {} (block {}), which needs {:.4g}{}",
                  p.least_stage, stage.ring, block_label(assembly_, stage.blocks.front()), p.least_stands,
                  staged_.least == StagedConstruction::Least::cohesion ? " Pa" : "");
}

std::string ConstructionRun::checkpoint() const {
  ConstructionProgress progress = progress_;
  progress.last_bracket = search_.last();
  BuiltState state = building_.state();
  ByteWriter archive;
  archive(progress, state);
  return archive.bytes();
}

void ConstructionRun::save() {
  write_tables();
  sinks_.checkpoint(checkpoint());
}

std::optional<Summary> ConstructionRun::run() {
  const double started = wall_seconds();
  if (!sinks_.resume_from.empty()) {
    BuiltState state;
    ByteReader archive(sinks_.resume_from);
    archive(progress_, state);
    search_.start_from(progress_.last_bracket);
    building_.restore(std::move(state), progress_.ring);
  } else if (!lay_foundation()) {
    return summary_;
  }
  while (progress_.next < static_cast<int>(stages_.size()) && !progress_.ended) {
    if (progress_.next > 0) {
      const bool interrupted = sinks_.interrupted();
      if (interrupted || saving_.is_due()) saving_.run([this] { save(); });
      if (interrupted) return std::nullopt;
    }
    if (!advance()) break;
  }
  write_tables();
  summary_.steps = progress_.solved;
  summary_.iterations = progress_.iterations;
  summary_.solve_time_seconds = wall_seconds() - started;
  progress_.worst.summarize(&summary_);
  summary_.accuracy.worst_over_run = progress_.worst_balance;
  judge();
  return summary_;
}

}  // namespace

std::optional<Summary> run_construction(const Case& scene, const Assembly& assembly,
                                        const AnalysisSinks& sinks) {
  return ConstructionRun(scene, assembly, sinks).run();
}

}  // namespace cupola
