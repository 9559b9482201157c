#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/csv_columns.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/stages.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

constexpr double kNarrowest = 1e-4;  // width of a bracket of friction; mortars do not differ by less

/// Result of one stage.
struct StageResult {
  int ring = 0;
  int blocks = 0;
  double weight = 0.0;  // N
  StaticOutcome outcome = StaticOutcome::unconverged;
  bool proven = false;
  double speed_ratio = 0.0;
  std::string message;              // of the static solve
  std::optional<Bracket> critical;  // of the fresh friction
  bool needs_none = false;          // stands without friction in the fresh bed
};

/// One stage with its contacts, which are detected once because they do not depend on friction.
class StageRun {
 public:
  StageRun(const Case& scene, const Assembly& complete, int ring,
           const std::function<void(const std::string&)>& log)
      : scene_(scene),
        stage_(build_stage(complete, ring)),
        complete_(stage_.assembly.blocks.size() == complete.blocks.size()) {
    ContactDetector detector(stage_.assembly, detection_options(scene));
    contacts_ = detector.update(initial_poses(stage_.assembly));
    options_ = static_options(scene.analysis);
    options_.log = log;
    search_options_ = verdict_options(scene.analysis);
    search_options_.log = log;
  }

  StaticSolution solve(double fresh_friction) { return solve(fresh_friction, options_); }
  /// As accurately as a verdict requires.
  StaticSolution attempt(double fresh_friction) { return solve(fresh_friction, search_options_); }
  /// Frame of the last solve, with the block numbers of the complete assembly.
  Frame frame(const StaticSolution& solution, const Assembly& complete) const;
  const Model& model() const { return model_; }
  const StaticOptions& options() const { return options_; }

 private:
  StaticSolution solve(double fresh_friction, const StaticOptions& options) {
    model_ = make_model(case_of_stage(scene_, stage_, fresh_friction, complete_), stage_.assembly);
    memories_ = memories_at_rest(model_, state_at_rest(model_), contacts_.points);
    return solve_static(model_, state_at_rest(model_), contacts_, memories_, options);
  }

  const Case& scene_;
  ConstructionStage stage_;
  bool complete_;
  ContactSet contacts_;
  ContactMemories memories_;
  StaticOptions options_, search_options_;
  Model model_;
};

Frame StageRun::frame(const StaticSolution& solution, const Assembly& complete) const {
  Frame frame = static_frame(model_, state_at_rest(model_), contacts_, memories_, solution, options_);
  frame.time = stage_.ring;
  set_role(stage_role(solution.outcome), fmt::format("ring {}", stage_.ring), &frame);
  for (int& block : frame.contacts.block_a) block = stage_.complete_block[static_cast<size_t>(block)];
  for (int& block : frame.contacts.block_b) block = stage_.complete_block[static_cast<size_t>(block)];
  BlockTable blocks;
  for (const Block& block : complete.blocks) {
    blocks.position.push_back(block.centroid);
    blocks.quaternion_wxyz.emplace_back(1.0, 0.0, 0.0, 0.0);
    blocks.velocity.push_back(Vec3::Zero());
    blocks.angular_velocity.push_back(Vec3::Zero());
    blocks.displacement.push_back(Vec3::Zero());
  }
  for (size_t i = 0; i < stage_.complete_block.size(); ++i) {
    const auto block = static_cast<size_t>(stage_.complete_block[i]);
    CUPOLA_ASSERT(block < complete.blocks.size());
    blocks.position[block] = frame.blocks.position[i];
    blocks.quaternion_wxyz[block] = frame.blocks.quaternion_wxyz[i];
    blocks.displacement[block] = frame.blocks.displacement[i];
    blocks.velocity[block] = frame.blocks.velocity[i];
    blocks.angular_velocity[block] = frame.blocks.angular_velocity[i];
  }
  frame.blocks = std::move(blocks);
  return frame;
}

/// Bracket of the smallest fresh friction at which the stage stands, between 0 and that of hardened joints.
Bracket critical_friction(const Case& scene, StageRun* run) {
  double hardened = scene.joints.friction;
  if (scene.joints.bed && scene.joints.bed->friction) hardened = *scene.joints.bed->friction;
  return bisect(0.0, hardened, {scene.analysis.staged.relative_width, kNarrowest}, [run](double friction) {
    const StaticSolution solution = run->attempt(friction);
    return LimitTrial{friction, solution.outcome, solution.speed_ratio};
  });
}

/// Searches for the fresh friction below which the stage does not stand.
void search_critical_friction(const Case& scene, StageRun* run, StageResult* stage) {
  stage->needs_none = run->attempt(0.0).outcome == StaticOutcome::equilibrium;
  if (!stage->needs_none) stage->critical = critical_friction(scene, run);
}

/// A stage with what its record needs. The residuals are those of the static solve.
struct SolvedStage {
  StageResult result;
  Frame frame;
  Summary summary;
  Residuals residuals;
  std::vector<std::string> log;  // if it was not given
};

SolvedStage solve_stage(const Case& scene, const Assembly& assembly, int ring,
                        const std::function<void(const std::string&)>& log) {
  SolvedStage solved;
  StageRun run(
      scene, assembly, ring, log ? log : [&solved](const std::string& line) { solved.log.push_back(line); });
  const StaticSolution solution = run.solve(scene.analysis.staged.fresh.friction);
  StageResult& stage = solved.result;
  stage.ring = ring;
  stage.blocks = run.model().num_free();
  stage.weight = run.model().free_weight;
  stage.outcome = solution.outcome;
  stage.proven = solution.proven;
  stage.speed_ratio = solution.speed_ratio;
  stage.message = solution.message;
  solved.frame = run.frame(solution, assembly);
  summarize_static(solution, solved.frame, run.model(), run.options().tolerance, &solved.summary);
  solved.residuals = solution.residuals;
  if (scene.analysis.staged.critical_friction) search_critical_friction(scene, &run, &stage);
  return solved;
}

std::string note(const StageResult& stage) {
  if (stage.needs_none) return "stands without friction";
  return stage.critical ? stage.critical->message : "";
}

const Bracket* bracket_of(const StageResult& stage) {
  return stage.critical && stage.critical->found ? &*stage.critical : nullptr;
}

constexpr CsvColumn<StageResult> kStageColumns[] = {
    {"ring", [](const StageResult& s) { return std::to_string(s.ring); }},
    {"blocks", [](const StageResult& s) { return std::to_string(s.blocks); }},
    {"weight_N", [](const StageResult& s) { return fmt::format("{:.9g}", s.weight); }},
    {"verdict", [](const StageResult& s) { return to_string(s.outcome); }},
    {"speed_ratio", [](const StageResult& s) { return fmt::format("{:.6e}", s.speed_ratio); }},
    {"critical_stands",
     [](const StageResult& s) -> std::string {
       if (const Bracket* bracket = bracket_of(s)) return fmt::format("{:.9g}", bracket->stable.value);
       return s.needs_none ? "0" : "";
     }},
    {"critical_moves",
     [](const StageResult& s) -> std::string {
       const Bracket* bracket = bracket_of(s);
       return bracket ? fmt::format("{:.9g}", bracket->moving.value) : "";
     }},
    {"note", [](const StageResult& s) { return note(s); }},
};

void judge(const std::vector<StageResult>& stages, double fresh_friction, Summary* summary) {
  const StageResult *worst = nullptr, *failed = nullptr;
  int moving = 0, unconverged = 0, need_none = 0;
  bool all_proven = true, motion_proven = false;  // one motion is enough to refute the construction
  for (const StageResult& stage : stages) {
    moving += stage.outcome == StaticOutcome::moving;
    unconverged += stage.outcome == StaticOutcome::unconverged;
    all_proven = all_proven && stage.proven;
    motion_proven = motion_proven || (stage.outcome == StaticOutcome::moving && stage.proven);
    need_none += stage.needs_none;
    if (stage.outcome == StaticOutcome::unconverged) failed = &stage;
    if (stage.critical && stage.critical->found &&
        (worst == nullptr || stage.critical->stable.value > worst->critical->stable.value))
      worst = &stage;
  }
  summary->status = unconverged > 0 ? Status::unconverged
                    : moving > 0    ? motion(motion_proven)
                                    : standing(all_proven);
  summary->message = fmt::format("stages that do not stand with a fresh friction of {:g}: {} of {}",
                                 fresh_friction, moving, stages.size());
  if (failed)
    summary->message +=
        fmt::format(", {} did not converge; ring {}: {}", unconverged, failed->ring, failed->message);
  if (need_none > 0)
    summary->message +=
        fmt::format("; {} without friction", counted(need_none, "stage stands", "stages stand"));
  if (worst == nullptr) return;
  const Bracket& bracket = *worst->critical;
  summary->critical =
      CriticalValue{"fresh friction", bracket.middle(), bracket.stable.value, bracket.moving.value};
  summary->message += fmt::format("; the most demanding stage is ring {}, which needs {:.4g}", worst->ring,
                                  bracket.stable.value);
}

}  // namespace

std::optional<Summary> run_staged(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const StagedConstruction& staged = scene.analysis.staged;
  int last_laid = 0;
  for (const Block& block : assembly.blocks) last_laid = std::max(last_laid, block.ring);
  const int last = staged.last_ring < 0 ? last_laid : std::min(staged.last_ring, last_laid);
  if (staged.first_ring > last)
    throw InputError(fmt::format("analysis.staged.first_ring = {}: must not exceed the last ring, {}",
                                 staged.first_ring, last));

  Summary summary;
  std::vector<StageResult> results;
  WorstOfRun worst;
  double worst_balance = 0.0;
  std::string table = csv_header(kStageColumns) + "\n";
  const double started = wall_seconds();
  const auto record = [&](const SolvedStage& solved) {
    const StageResult& stage = solved.result;
    for (const std::string& line : solved.log) sinks.log(line);
    sinks.frame(solved.frame);
    summary = solved.summary;
    worst.include(solved.residuals, summary.certified_force_error, summary.forces_unique,
                  largest_violation(solved.frame));
    if (!(summary.accuracy.reached <= worst_balance)) worst_balance = summary.accuracy.reached;
    table += csv_row(kStageColumns, stage) + "\n";
    results.push_back(stage);
    sinks.table("stages.csv", table);
    sinks.log(fmt::format("ring {:4d}  blocks {:6d}  {:<11}  |v|/(g h) {:9.2e}  {}", stage.ring, stage.blocks,
                          to_string(stage.outcome), stage.speed_ratio, note(stage)));
    sinks.progress(static_cast<double>(stage.ring - staged.first_ring + 1) / (last - staged.first_ring + 1),
                   fmt::format("ring {} of {}, {}", stage.ring, last, to_string(stage.outcome)));
  };
  // No stage knows another: each thread solves whole ones. They are recorded in their order.
  constexpr double kWork = 1e12;  // of one batch: always worth all threads
  constexpr int kStagesPerThread = 4;
  const int batch = num_threads() == 1 ? 1 : num_threads() * kStagesPerThread;
  for (int first = staged.first_ring; first <= last; first += batch) {
    const int size = std::min(batch, last - first + 1);
    std::vector<SolvedStage> solved(static_cast<size_t>(size));
    share_loop(kWork, size, [&](int i) {
      solved[i] = solve_stage(scene, assembly, first + i, size == 1 ? sinks.log : nullptr);
    });
    for (const SolvedStage& stage : solved) record(stage);
    if (sinks.interrupted()) return std::nullopt;
  }
  summary.steps = static_cast<int>(results.size());
  summary.solve_time_seconds = wall_seconds() - started;
  worst.summarize(&summary);
  summary.accuracy.worst_over_run = worst_balance;
  judge(results, staged.fresh.friction, &summary);
  return summary;
}

}  // namespace cupola
