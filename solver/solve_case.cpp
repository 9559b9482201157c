#include "solver/solve_case.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/results_file.hpp"
#include "assembly/model/block_names.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record.hpp"
#include "solver/collision/geometry_warnings.hpp"
#include "solver/collision/patch_file.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/explain.hpp"
#include "solver/fclib/fclib_file.hpp"
#include "solver/runtime/checkpoint.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/run_control.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// Reads the assembly and replaces the names of blocks in the case by their numbers.
Assembly read_matching_assembly(SolveRequest* asked) {
  SolveRequest& request = *asked;
  const std::string& path = request.assembly_path;
  Assembly assembly = read_assembly(path);
  resolve_block_names(assembly, &request.scene.loads, &request.scene.ties, &request.scene.supports);
  const bool any_fixed = std::ranges::any_of(assembly.blocks, [](const Block& block) { return block.fixed; });
  if (!any_fixed && request.scene.analysis.type != AnalysisType::dynamic)
    throw InputError(FileLocation{path}, kNoBlockIsFixed);
  if (assembly.geometry_hash == request.scene.geometry_hash) return assembly;
  const std::string differs =
      fmt::format("was not made from {}: geometry or material differ", request.scene.file);
  if (!request.force)
    throw InputError(FileLocation{path}, differs + "; run cupola-generate again, or use it with --force");
  fmt::print(stderr, "cupola-solve: warning: {} {}\n", path, differs);
  return assembly;
}

void print_warnings(const std::vector<std::string>& warnings) {
  constexpr std::size_t kShown = 10;
  for (std::size_t i = 0; i < std::min(kShown, warnings.size()); ++i)
    fmt::print(stderr, "warning: {}\n", warnings[i]);
  if (warnings.size() > kShown)
    fmt::print(stderr, "warning: {} more of the same kind\n", warnings.size() - kShown);
}

std::string provenance(const Summary& summary) {
  return fmt::format(
      "# Effective options of one run of cupola-solve.\n"
      "# program_version: {}\n# case_hash: {}\n# geometry_hash: {}\n# assembly_hash: {}\n"
      "# threads: {}\n",
      summary.program_version, summary.case_hash, summary.geometry_hash, summary.assembly_hash,
      summary.threads);
}

/// The residuals that the run has, with the state that they describe.
std::string residuals_line(const Summary& summary) {
  std::vector<std::string> parts;
  const auto add = [&parts](const char* name, const std::optional<double>& value) {
    if (value) parts.push_back(fmt::format("{} {:.2e}", name, *value));
  };
  add("momentum", summary.momentum_residual);
  add("contact law", summary.contact_law_residual);
  add("friction cone", summary.friction_cone_violation);
  if (const auto& violation = summary.largest_law_violation)
    parts.push_back(fmt::format("worst contact {:.2e} (blocks {} and {})", violation->value,
                                violation->block_a, violation->block_b));
  const bool run_of_steps = summary.steps > 1 && summary.analysis != AnalysisType::limit;
  add(run_of_steps ? "equilibrium at the end" : "equilibrium", summary.equilibrium_residual);
  if (parts.empty()) return "no residuals: no state was found that they could describe";
  const char* state = summary.analysis == AnalysisType::limit ? " at the stable end of the bracket"
                      : run_of_steps                          ? ", worst over the run"
                                                              : "";
  return fmt::format("residuals{}: {}", state, fmt::join(parts, ", "));
}

void print_summary(const Summary& summary) {
  fmt::print("{}: {}\n", to_string(summary.status), summary.message);
  if (!summary.forces_unique.value) fmt::print("  {}\n", to_sentence(summary.forces_unique));
  fmt::print("  {} free blocks, {} joints, {} contacts, {} unknowns\n", summary.free_blocks, summary.joints,
             summary.contacts, summary.unknowns);
  fmt::print("  weight {:.6e} N, support reaction {:.6e} N along z\n", summary.weight_N,
             summary.support_reaction_N.z());
  fmt::print("  {}\n  {}\n  {}\n", to_sentence(summary.accuracy), residuals_line(summary),
             to_sentence(summary.certified_force_error));
  fmt::print("  law: {}, tangential spring: {}; {} of {} contacts slip\n", to_string(summary.friction_law),
             to_string(summary.tangential), summary.slipping_contacts, summary.contacts);
  fmt::print("  solve {:.3f} s, total {:.3f} s, peak memory {:.0f} MB\n", summary.solve_time_seconds,
             summary.wall_time_seconds, static_cast<double>(summary.peak_memory_bytes) / 1e6);
}

/// The checkpoint from which the run resumes. None if it starts from the beginning.
std::optional<Checkpoint> find_checkpoint(const SolveRequest& request, const std::string& path,
                                          const std::string& assembly_hash) {
  if (!request.resume) return std::nullopt;
  std::optional<Checkpoint> checkpoint = read_checkpoint(path);
  if (!checkpoint) return std::nullopt;
  const char* other = checkpoint->case_hash != request.scene.hash        ? "case"
                      : checkpoint->assembly_hash != assembly_hash       ? "assembly"
                      : checkpoint->program_version != program_version() ? "program version"
                                                                         : nullptr;
  if (other == nullptr) return checkpoint;
  fmt::print(stderr,
             "cupola-solve: warning: {}: the checkpoint belongs to another {}; starting from the beginning\n",
             path, other);
  return std::nullopt;
}

/// Connects an analysis to the results folder and the terminal.
AnalysisSinks make_sinks(const SolveRequest& request, const std::string& checkpoint_path,
                         const StopRequest& stop, ResultsWriter* writer, Checkpoint* run,
                         ProgressBar* progress, std::string* last_line) {
  AnalysisSinks sinks;
  const bool bar = !request.quiet && stdout_is_terminal();
  sinks.log = [&request, bar, last_line](const std::string& line) {
    *last_line = line;
    if (!request.quiet && !bar) fmt::print("{}\n", line), std::fflush(stdout);
  };
  if (bar) sinks.progress = [progress](double share) { progress->show(share); };
  sinks.history = [run](const std::string& row) { run->history += row + "\n"; };
  sinks.frame = [writer, run](const Frame& frame) {
    writer->write_frame(frame);
    run->frame_times.push_back(frame.time);
    if (!run->history.empty()) writer->write_text("history.csv", run->history);
  };
  sinks.table = [writer](const std::string& name, const std::string& text) {
    writer->write_text(name, text);
  };
  sinks.checkpoint = [run, checkpoint_path](const std::string& bytes) {
    run->analysis = bytes;
    write_checkpoint(checkpoint_path, *run);
  };
  if (!request.dump_fclib.empty()) {
    sinks.problem = [&request](const ContactProblem& problem, const VecX& gamma) {
      write_fclib(request.dump_fclib, request.scene.title, make_delassus(problem), gamma);
    };
  }
  sinks.interrupted = [&stop] { return stop.made(); };
  sinks.resume_from = run->analysis;
  return sinks;
}

/// None if the user interrupted the analysis, between its steps or inside one.
std::optional<Summary> summary_unless_interrupted(const Case& scene, const Assembly& assembly,
                                                  const AnalysisSinks& sinks) {
  try {
    return run_analysis(scene, assembly, sinks);
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

ExitCode interrupted_before_solving() {
  fmt::print(stderr, "interrupted before the analysis started\n");
  return ExitCode::interrupted;
}

}  // namespace

ExitCode solve_case(SolveRequest request) {
  const StopRequest stop;
  const double started = wall_seconds();
  const Assembly assembly = read_matching_assembly(&request);
  const std::string assembly_hash = content_hash(assembly);
  const std::string checkpoint_path = (std::filesystem::path(request.output_folder) / "checkpoint").string();

  set_num_threads(request.threads);
  if (stop.made()) return interrupted_before_solving();
  try {
    print_warnings(geometry_warnings(assembly, detection_options(request.scene)));
  } catch (const Interrupted&) {
    return interrupted_before_solving();
  }

  // 1. Start or resume
  Checkpoint run = find_checkpoint(request, checkpoint_path, assembly_hash).value_or(Checkpoint{});
  if (!run.analysis.empty() && !request.quiet)
    fmt::print("resuming {}\n",
               run.frame_times.empty()
                   ? "before the first frame"
                   : fmt::format("after frame {} at {:g} s", run.frame_times.size(), run.frame_times.back()));
  run.program_version = program_version();
  run.case_hash = request.scene.hash;
  run.assembly_hash = assembly_hash;
  ResultsWriter writer(request.output_folder, assembly_hash, run.frame_times);
  // A summary marks a folder as complete: remove the old one before the first frame is replaced.
  std::filesystem::remove(std::filesystem::path(request.output_folder) / "summary.json");

  // 2. The analysis
  ProgressBar progress;
  std::string last_line;
  AnalysisSinks sinks = make_sinks(request, checkpoint_path, stop, &writer, &run, &progress, &last_line);
  const std::string patches_path = (std::filesystem::path(request.output_folder) / "patches.vtp").string();
  bool patches_written = false;
  sinks.as_built = [&](const ContactSet& contacts) {
    write_patches(patches_path, contacts, assembly_hash);
    patches_written = true;
  };
  std::optional<Summary> summary = summary_unless_interrupted(request.scene, assembly, sinks);
  progress.finish();
  if (!summary) {
    const bool resumable = std::filesystem::exists(checkpoint_path);
    writer.write_interruption({run.program_version, run.case_hash, run.assembly_hash, resumable,
                               static_cast<int>(run.frame_times.size()), last_line,
                               wall_seconds() - started});
    fmt::print(stderr, "interrupted; {}\n",
               resumable ? "to continue, repeat the make or cupola command, or this one with --resume"
                         : "run the same command again: nothing was saved that it could resume");
    return ExitCode::interrupted;
  }

  // 3. Summary
  summary->program_version = program_version();
  summary->case_hash = request.scene.hash;
  summary->geometry_hash = request.scene.geometry_hash;
  summary->assembly_hash = assembly_hash;
  summary->threads = request.threads;
  summary->wall_time_seconds = wall_seconds() - started;
  summary->cpu_time_seconds = cpu_seconds();
  summary->peak_memory_bytes = peak_memory_bytes();
  writer.write_text("run.yaml", provenance(*summary) + request.scene.effective_yaml);
  // Written again even if an interrupted run wrote it: the summary lists the files that this run wrote.
  if (!run.history.empty()) writer.write_text("history.csv", run.history);
  if (!patches_written)
    sinks.as_built(
        ContactDetector(assembly, detection_options(request.scene)).update(initial_poses(assembly)));
  writer.write_summary(*summary);
  if (!request.quiet) print_summary(*summary);
  return summary->status == Status::unconverged ? ExitCode::accuracy_not_reached : ExitCode::done;
}

std::string explain_case(SolveRequest request) {
  return explain_model(request.scene, read_matching_assembly(&request)).text;
}

}  // namespace cupola
