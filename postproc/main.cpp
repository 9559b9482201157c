// cupola-post: evaluates the contact forces of a run and writes tables, figures, a report and files for
// ParaView.
//
// Sample runs:
//   cupola-post analyse cases/dome_circular.yaml --assembly assembly.vtu --results results/ --output post/
//   cupola-post export cases/dome_circular.yaml --assembly assembly.vtu --results results/ --output dome.gltf
//   cupola-post compare out/A/post out/B/post --output comparison/
//   cupola-post study cases/studies/paper.yaml --runs out/ --output out/paper/
//   cupola-post study cases/friction_sweep.yaml --runs out/ --output out/friction_sweep/
//   cupola-post columns > columns.md

#include <cstring>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/key_places.hpp"
#include "assembly/export/export.hpp"
#include "assembly/program/batch.hpp"
#include "assembly/program/command_line.hpp"
#include "postproc/analyse.hpp"
#include "postproc/compare/compare.hpp"
#include "postproc/export_run.hpp"
#include "postproc/report/load_path.hpp"
#include "postproc/report/stages.hpp"
#include "postproc/studies/study_command.hpp"
#include "postproc/tables/result_columns.hpp"

namespace {

using namespace cupola;

constexpr const char* kUsage =
    "cupola-post: evaluates the contact forces of finished runs.\n\n"
    "  cupola-post analyse CASE.yaml --assembly FILE --results FOLDER --output FOLDER\n"
    "  cupola-post export CASE.yaml --assembly FILE --results FOLDER --output FILE\n"
    "  cupola-post compare POST POST ... --output FOLDER\n"
    "  cupola-post study STUDY.yaml --runs FOLDER --output FOLDER\n"
    "  cupola-post columns\n\n"
    "`cupola-post COMMAND --help` lists the options.\n";

/// The options that name the files of a run.
void add_run(CommandLine* line, RunInput* run) {
  line->required("--assembly", &run->assembly_path, "FILE", "assembly file that was solved");
  line->required("--results", &run->results_folder, "FOLDER", "output folder of cupola-solve");
  line->flag("--force", &run->force, "accept an assembly or results of another case");
}

ExitCode run_analyse(int argc, char** argv) {
  // 1. Command line
  AnalyseRequest request;
  CommandLine line(
      "cupola-post analyse", "Evaluates a run: wrenches, thrust lines, sections, figures, report.",
      "  cupola-post analyse dome.yaml --assembly assembly.vtu --results results/ --output post/");
  add_run(&line, &request.run);
  line.required("--output", &request.output_folder, "FOLDER",
                "folder for the report, tables, figures and meshes");
  line.flag("--tables", &request.tables_only, "write only the tables and the summary");
  line.flag("--pictures", &request.pictures,
            "draw the standard 3-D views, as PNG in the folder pictures (needs Xvfb)");
  if (const auto ended = line.parse(argc, argv)) return *ended;

  // 2. Case
  request.run.scene = line.read_case();
  request.run.strict = line.strict();
  request.quiet = line.quiet();
  if (request.tables_only && request.pictures)
    throw InputError("--tables draws nothing: leave out --tables or --pictures");
  if (line.check_only()) return line.report_warnings(request.run.scene.warnings), ExitCode::done;

  // 3. Evaluation and output
  return with_places_of_keys(request.run.scene, [&] { return analyse(request); });
}

ExitCode run_export(int argc, char** argv) {
  RunInput input;
  std::string output;
  CommandLine line(
      "cupola-post export", "Writes the blocks and joint forces of a run for another program.",
      "  cupola-post export dome.yaml --assembly assembly.vtu --results results/ --output dome.gltf");
  add_run(&line, &input);
  line.required("--output", &output, "FILE", std::string("file to write: ") + kExportFormats);
  if (const auto ended = line.parse(argc, argv)) return *ended;
  input.scene = line.read_case();
  input.strict = line.strict();
  if (line.check_only()) return line.report_warnings(input.scene.warnings), ExitCode::done;
  return with_places_of_keys(input.scene, [&] { return export_run(input, output, line.quiet()); });
}

ExitCode run(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "analyse") return run_analyse(argc - 1, argv + 1);
  if (command == "export") return run_export(argc - 1, argv + 1);
  if (command == "compare") return run_compare(argc - 1, argv + 1);
  if (command == "study") return run_study(argc - 1, argv + 1);
  if (command == "columns") {
    fmt::print("{}",
               column_reference({{"path.csv", path_columns()},
                                 {"stages.csv", construction_columns(StagedConstruction::Least::cohesion)}}));
    return ExitCode::done;
  }
  if (command == "--version") {
    fmt::print("{}\n", version_line("cupola-post"));
    return ExitCode::done;
  }
  if (command == "--help" || command == "-h") {
    fmt::print("{}", kUsage);
    return ExitCode::done;
  }
  if (command.empty())
    throw InputError("the command is missing; use analyse, export, compare, study or columns");
  throw InputError(
      fmt::format("unknown command `{}`; use analyse, export, compare, study or columns", command));
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("cupola-post", argc, argv, [](int count, char** arguments) -> PreparedRun {
    // The strings of a batch last until its run has begun in a process of its own.
    return [count, arguments] { return run(count, arguments); };
  });
}
