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

/// Parses the arguments. Returns how the command ends when it need not go on: --help and --version print and
/// end with `done`. Throws InputError for bad usage, naming the option.
std::optional<ExitCode> parse_arguments(CLI::App& app, int argc, const char* const* argv);

/// Command line of one program: CASE.yaml and the options that all programs share, plus its own.
///
///     CommandLine line("cupola-generate", "Cuts a case's vault into blocks.", "cupola-generate a.yaml ...");
///     line.required("--output", &output, "FILE", "assembly to write (.vtu)");
///     if (const auto ended = line.parse(argc, argv)) return *ended;
///     const Case scene = line.read_case();
class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& description, const std::string& sample_runs);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A string option that must be given, unless the run only checks the case or prints something.
  void required(const std::string& option, std::string* value, const std::string& what,
                const std::string& help);
  void optional(const std::string& option, std::string* value, const std::string& what,
                const std::string& help);
  void optional(const std::string& option, int* value, int smallest, const std::string& help);
  /// A string option that replaces CASE and the required options: another kind of run.
  void instead_of_case(const std::string& option, std::string* value, const std::string& what,
                       const std::string& help);
  void flag(const std::string& option, bool* value, const std::string& help);

  /// Returns how the program ends when it need not go on: --help, --version and --schema print and end with
  /// `done`. Throws InputError for bad usage, naming the option.
  std::optional<ExitCode> parse(int argc, const char* const* argv);

  /// The case named on the command line with --set applied.
  Case read_case() const;

  bool check_only() const { return check_only_; }  ///< --check: validate and stop
  bool quiet() const { return quiet_; }            ///< --quiet: errors only

 private:
  std::unique_ptr<CLI::App> app_;
  std::string case_path_;
  std::vector<std::string> set_options_;
  std::vector<std::pair<std::string, std::string*>> required_;
  std::vector<std::string*> instead_of_case_;
  bool check_only_ = false;
  bool quiet_ = false;
  bool schema_ = false;
};

}  // namespace cupola
