#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/program/program.hpp"

namespace CLI {
class App;
}

namespace cupola {

/// What --version prints: name, version and revision of this build, and under which licences it and its
/// source are.
std::string version_line(const std::string& program);

/// Parses the arguments. Returns an exit code if the program is to stop: --help and --version print and
/// return `done`. Throws InputError that names the option for bad usage.
std::optional<ExitCode> parse_arguments(CLI::App& app, int argc, const char* const* argv);

/// Command line of one program: CASE.yaml, the options common to all programs, and its own.
///
///     CommandLine line("cupola-generate", "Cuts a vault into blocks.", "cupola-generate a.yaml ...");
///     line.required("--output", &output, "FILE", "assembly to write (.vtu)");
///     if (const auto ended = line.parse(argc, argv)) return *ended;
///     const Case scene = line.read_case();
class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& description, const std::string& sample_runs);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A required string option; not required for --check, --schema, --help and --version.
  void required(const std::string& option, std::string* value, const std::string& what,
                const std::string& help);
  void optional(const std::string& option, std::string* value, const std::string& what,
                const std::string& help);
  void optional(const std::string& option, int* value, int smallest, const std::string& help);
  void flag(const std::string& option, bool* value, const std::string& help);

  /// Returns an exit code if the program is to stop: --help, --version and --schema print and return `done`.
  /// Throws InputError that names the option for bad usage.
  std::optional<ExitCode> parse(int argc, const char* const* argv);

  /// Reads the case named on the command line and applies the --set options.
  Case read_case() const;

  /// report_warnings() as the program and with --strict of this command line. A case that is only checked has
  /// no `printed_before`.
  void report_warnings(const std::vector<std::string>& warnings,
                       const std::vector<std::string>& printed_before = {}) const;

  bool strict() const { return strict_; }          ///< --strict: warnings are errors
  bool check_only() const { return check_only_; }  ///< --check: validate and stop
  bool quiet() const { return quiet_; }            ///< --quiet: warnings and errors only

 private:
  std::unique_ptr<CLI::App> app_;
  std::string case_path_;
  std::vector<std::string> set_options_;
  std::vector<std::pair<std::string, std::string*>> required_;
  bool check_only_ = false;
  bool list_inputs_ = false, hash_inputs_ = false;
  bool strict_ = false;
  bool quiet_ = false;
  bool json_ = false;
  std::string schema_key_;  // after --schema
};

}  // namespace cupola
