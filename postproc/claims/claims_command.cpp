#include "postproc/claims/claims_command.hpp"

#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/command_line.hpp"
#include "postproc/claims/claims_report.hpp"

namespace cupola {

ExitCode run_claims(int argc, const char* const* argv) {
  // 1. Command line
  std::string claims_path, runs_folder, output_folder;
  bool needs_only = false;
  CLI::App app("Tests the claims of a publication against finished runs.", "cupola-post claims");
  app.add_option("CLAIMS", claims_path, "claims file (.yaml)")->required();
  app.add_option("--runs", runs_folder, "folder with one subfolder per run")->type_name("FOLDER");
  app.add_option("--output", output_folder, "folder for claims.csv and claims.html")->type_name("FOLDER");
  app.add_flag("--needs", needs_only, "print the names of the runs that the claims read, and exit");
  if (const auto ended = parse_arguments(app, argc, argv)) return *ended;

  // 2. Read the claims
  const ClaimsFile file = read_claims(claims_path);
  const std::vector<Claim>& claims = file.claims;
  if (needs_only) {
    for (const std::string& run : needed_runs(file)) fmt::print("{}\n", run);
    return ExitCode::done;
  }
  if (runs_folder.empty()) throw InputError("option --runs is missing; see cupola-post claims --help");
  if (!std::filesystem::is_directory(runs_folder))
    throw InputError(FileLocation{runs_folder}, "--runs: the folder of the runs does not exist");

  // 3. Evaluate and write
  const std::vector<ClaimResult> results = evaluate_claims(claims, runs_folder);
  fmt::print("{}", claims_text(claims, results));
  if (output_folder.empty()) return ExitCode::done;
  make_folder(output_folder);
  write_text_atomically(output_folder + "/claims.csv", to_csv(claims_table(claims, results)));
  write_text_atomically(output_folder + "/claims.html", claims_html(file, results, runs_folder));
  return ExitCode::done;
}

}  // namespace cupola
