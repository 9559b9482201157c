#include "solver/solve_case.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/case/keys_without_effect.hpp"
#include "assembly/case/plausibility.hpp"
#include "assembly/case/resolve_thresholds.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/folder_lock.hpp"
#include "assembly/files/number_text.hpp"
#include "assembly/files/results_file.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/ending.hpp"
#include "assembly/model/relative_compliance.hpp"
#include "assembly/program/terminal.hpp"
#include "assembly/program/warnings.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/analysis_table.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/collision/geometry_warnings.hpp"
#include "solver/collision/patch_file.hpp"
#include "solver/dynamics/joints_on_supports.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/explain.hpp"
#include "solver/runtime/checkpoint.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/iteration_log.hpp"
#include "solver/runtime/run_control.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// Reads the assembly and replaces the names of blocks in the case by their numbers. With --force, `differs`
/// gets how the assembly differs from the case.
Assembly read_matching_assembly(SolveRequest* asked, std::vector<std::string>* differences) {
  SolveRequest& request = *asked;
  const std::string& path = request.assembly_path;
  Assembly assembly = read_assembly(path);
  refuse_keys_without_effect(request.scene, assembly);
  resolve_block_names(assembly, &request.scene.loads, &request.scene.ties, &request.scene.supports);
  resolve_block_names(assembly, &request.scene.analysis.range.quantities);
  for (BlockRef& block : request.scene.analysis.staged.sequence)
    resolve_block_name(assembly, "analysis.staged.sequence", &block);
  resolve_compliance(assembly, request.scene.loads.gravity, &request.scene.joints.compliance);
  resolve_thresholds(assembly, &request.scene.analysis.thresholds);
  if (auto& control = request.scene.analysis.path.control) {
    resolve_block_name(assembly, "analysis.path.control", &control->block);
    if (control->relative_to)
      resolve_block_name(assembly, "analysis.path.control.relative_to", &*control->relative_to);
  }
  const bool any_fixed = std::ranges::any_of(assembly.blocks, [](const Block& block) { return block.fixed; });
  if (!any_fixed && !analysis_traits(request.scene.analysis.type).steps_in_time)
    throw InputError(FileLocation{path}, kNoBlockIsFixed);
  if (assembly.geometry_hash == request.scene.geometry_hash) return assembly;
  const std::string differs =
      fmt::format("was not made from {}: geometry or material differ", request.scene.file);
  if (!request.force)
    throw InputError(FileLocation{path}, differs + "; run cupola-generate again, or use it with --force");
  differences->push_back(fmt::format("{} {}", path, differs));
  return assembly;
}

/// Warnings of the run. They are reported when they are found, except those that the generator has printed.
class RunWarnings {
 public:
  RunWarnings(const Assembly& assembly, bool strict)
      : printed_(united({assembly.case_warnings, assembly.block_warnings})), strict_(strict) {}

  /// Throws InputError if warnings are errors.
  void add(const std::vector<std::string>& found) {
    report_warnings("cupola-solve", found, united({printed_, all_}), strict_);
    all_ = united({all_, found});
  }
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::vector<std::string> printed_, all_;
  bool strict_;
};

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
  const AnalysisTraits& traits = analysis_traits(summary.analysis);
  const bool run_of_steps = summary.steps > 1 && traits.many_states;
  add(run_of_steps ? "equilibrium at the end" : "equilibrium", summary.equilibrium_residual);
  if (parts.empty()) return "no residuals: no state was found that they could describe";
  const char* state = run_of_steps ? ", worst over the run" : traits.state;
  return fmt::format("residuals{}: {}", state, fmt::join(parts, ", "));
}

void print_forces(const Summary& summary) {
  if (!summary.forces_unique.value) fmt::print("  {}\n", to_sentence(summary.forces_unique));
  fmt::print("  weight {}, support reaction {} along z\n", readable_force(summary.weight_N),
             readable_force(summary.support_reaction_N.z()));
  fmt::print("  {}\n  {}\n  {}\n", to_sentence(summary.accuracy), residuals_line(summary),
             to_sentence(summary.certified_force_error));
  fmt::print("  law: {}, tangential spring: {}; contacts that slip: {} of {}\n",
             to_string(summary.friction_law), to_string(summary.tangential), summary.slipping_contacts,
             summary.contacts);
}

void print_summary(const Summary& summary, bool verbose) {
  const Colour colour = stands(summary.status)    ? Colour::green
                        : reached(summary.status) ? Colour::yellow
                                                  : Colour::red;
  // A limit that was found leads with the critical value, not with the status of one end of its bracket.
  if (summary.critical && summary.analysis == AnalysisType::limit && reached(summary.status))
    fmt::print("{}\n", in_colour(summary.message, colour, stdout));
  else
    fmt::print("{}: {}\n", in_colour(words_of(summary), colour, stdout), summary.message);
  if (!verbose) {
    fmt::print("  {}, weight {}; {:.3g} s; --verbose prints steps and residuals\n",
               counted(summary.free_blocks, "free block"), readable_force(summary.weight_N),
               summary.wall_time_seconds);
    return;
  }
  fmt::print("  {}, {}, {}, {}\n", counted(summary.free_blocks, "free block"),
             counted(summary.joints, "joint"), counted(summary.contacts, "contact"),
             counted(summary.unknowns, "unknown"));
  if (!moves(summary.status) || summary.max_speed_m_per_s)
    print_forces(summary);  // those of a static solve that found a motion balance nothing
  else
    fmt::print("  weight {}; law: {}\n", readable_force(summary.weight_N), to_string(summary.friction_law));
  fmt::print("  solve {:.3f} s, total {:.3f} s, peak memory {:.0f} MB\n", summary.solve_time_seconds,
             summary.wall_time_seconds, static_cast<double>(summary.peak_memory_bytes) / 1e6);
}

/// Throws InputError if the run would remove or replace a file that the case reads.
void check_output_folder(const SolveRequest& request) {
  namespace fs = std::filesystem;
  const fs::path output = fs::weakly_canonical(fs::absolute(request.output_folder));
  for (const fs::path input : request.scene.inputs)
    if (is_result_file(input.filename().string()) && fs::canonical(input).parent_path() == output)
      throw InputError(
          FileLocation{input.string()},
          "the run would replace this file, which the case reads; give another folder as --output");
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
  report_warnings(
      "cupola-solve",
      {fmt::format("{}: the checkpoint belongs to another {}; starting from the beginning", path, other)}, {},
      false);
  return std::nullopt;
}

/// Connects an analysis to the results folder and the terminal.
AnalysisSinks make_sinks(const SolveRequest& request, const std::string& checkpoint_path,
                         const StopRequest& stop, const FolderLock& lock, ResultsWriter* writer,
                         Checkpoint* run, ProgressBar* progress, std::string* last_line) {
  AnalysisSinks sinks;
  const bool has_progress = analysis_traits(request.scene.analysis.type).many_states;
  const bool live = !request.quiet && !request.verbose && is_terminal(stdout);
  sinks.log = [&request, progress, one_line = live && !has_progress, last_line](const std::string& line) {
    *last_line = line;
    if (request.verbose && !request.quiet) fmt::print("{}\n", line), std::fflush(stdout);
    if (one_line) progress->show(line);
  };
  if (live && has_progress)
    sinks.progress = [progress](double share, const std::string& state) { progress->show(share, state); };
  sinks.history = [run](const std::string& row) { run->history += row + "\n"; };
  sinks.frame = [writer, run, &lock, history = Growth()](const Frame& frame) mutable {
    lock.check();
    writer->write_frame(frame);
    run->frame_times.push_back(frame.time);
    if (run->history.empty() || !history.is_due(run->history.size())) return;
    writer->write_text("history.csv", run->history);
    history.written(run->history.size());
  };
  sinks.table = [writer](const std::string& name, const std::string& text) {
    writer->write_growing(name, text);
  };
  sinks.checkpoint = [run, writer, checkpoint_path](const std::string& bytes) {
    writer->finish_tables();  // a run that is resumed at its end writes no table again
    run->analysis = bytes;
    write_checkpoint(checkpoint_path, *run);
  };
  sinks.interrupted = [&stop] { return stop.made(); };
  sinks.resume_from = run->analysis;
  return sinks;
}

/// None if the user interrupted the analysis, between its steps or inside one.
std::optional<Summary> summary_unless_interrupted(const Case& scene, const Assembly& assembly,
                                                  const AnalysisSinks& sinks) {
  try {
    if (!analysis_traits(scene.analysis.type).one_solve)  // which detects the contacts as built itself
      sinks.as_built(ContactDetector(assembly, detection_options(scene)).update(initial_poses(assembly)));
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
  check_output_folder(request);
  std::vector<std::string> differences;
  const Assembly assembly = read_matching_assembly(&request, &differences);
  const std::string assembly_hash = content_hash(assembly);
  const std::string checkpoint_path = (std::filesystem::path(request.output_folder) / "checkpoint").string();

  set_num_threads(request.threads);
  if (stop.made()) return interrupted_before_solving();
  RunWarnings warnings(assembly, request.strict);
  try {
    warnings.add(
        united({differences, request.scene.warnings, implausible_for_blocks(request.scene, assembly),
                assembly.block_warnings, geometry_warnings(assembly, detection_options(request.scene))}));
  } catch (const Interrupted&) {
    return interrupted_before_solving();
  }

  // 1. Start or resume
  const FolderLock lock(request.output_folder);
  Checkpoint run = find_checkpoint(request, checkpoint_path, assembly_hash).value_or(Checkpoint{});
  if (!run.analysis.empty() && !request.quiet)
    fmt::print("resuming {}\n",
               run.frame_times.empty()
                   ? "before the first frame"
                   : fmt::format("after frame {} at {:g} s", run.frame_times.size(), run.frame_times.back()));
  // A checkpoint of another run would be offered if this one is interrupted before it writes its own.
  if (run.analysis.empty()) std::filesystem::remove(checkpoint_path);
  run.program_version = program_version();
  run.case_hash = request.scene.hash;
  run.assembly_hash = assembly_hash;
  ResultsWriter writer(request.output_folder, assembly_hash, run.frame_times, run.case_hash);

  // 2. The analysis
  ProgressBar progress;
  std::string last_line;
  AnalysisSinks sinks =
      make_sinks(request, checkpoint_path, stop, lock, &writer, &run, &progress, &last_line);
  const std::string patches_path = (std::filesystem::path(request.output_folder) / "patches.vtp").string();
  sinks.as_built = [&](const ContactSet& contacts) {
    const Analysis& analysis = request.scene.analysis;
    const bool rigid = analysis.type == AnalysisType::limit && uses_direct_limit(analysis);
    warnings.add(joint_warnings(request.scene, assembly, contacts, rigid));
    write_patches(patches_path, contacts, assembly_hash);
  };
  const IterationLog iterations(sinks.log);
  std::optional<Summary> summary = summary_unless_interrupted(request.scene, assembly, sinks);
  progress.finish();
  if (!summary) {
    const bool resumable = std::filesystem::exists(checkpoint_path);
    if (!run.history.empty()) writer.write_text("history.csv", run.history);
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
  const std::vector<std::string> of_results = summary->warnings;
  summary->warnings = united({of_results, warnings.all()});
  lock.check();
  writer.write_text("run.yaml", provenance(*summary) + request.scene.effective_yaml);
  // Written again even if an interrupted run wrote it: the summary lists the files that this run wrote.
  if (!run.history.empty()) writer.write_text("history.csv", run.history);
  writer.write_summary(*summary);
  // Only interrupted runs need it, and what it holds depends on the time at which it was saved.
  std::filesystem::remove(checkpoint_path);
  warnings.add(of_results);  // not before: what ran stays on disk even if --strict makes them errors
  if (!request.quiet) print_summary(*summary, request.verbose);
  return reached(summary->status) ? ExitCode::done : ExitCode::accuracy_not_reached;
}

std::string explain_case(SolveRequest request) {
  std::vector<std::string> differences;
  const Assembly assembly = read_matching_assembly(&request, &differences);
  RunWarnings(assembly, request.strict)
      .add(united({differences, request.scene.warnings, implausible_for_blocks(request.scene, assembly)}));
  return explain_model(request.scene, assembly).text;
}

}  // namespace cupola
