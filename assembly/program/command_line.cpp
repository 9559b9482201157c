#include "assembly/program/command_line.hpp"

#include <set>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/program/warnings.hpp"

namespace cupola {
namespace {

/// The arguments with `--set` before each pair KEY=VALUE that follows another: `--set a=1 b=2` sets both.
std::vector<const char*> with_set_before_each_pair(int argc, const char* const* argv) {
  std::vector<const char*> out;
  bool after_pair = false;
  for (int i = 0; i < argc; ++i) {
    const std::string_view word = argv[i];
    const bool is_pair = !word.starts_with('-') && word.find('=') != word.npos;
    if (after_pair && is_pair && out.back() != std::string_view("--set")) out.push_back("--set");
    after_pair = is_pair && out.back() == std::string_view("--set");
    out.push_back(argv[i]);
  }
  return out;
}

}  // namespace

std::string version_line(const std::string& program) {
  return fmt::format(
      "{} {}; binary: GPL-3.0-or-later, because the programs link CGAL and CHOLMOD; source: BSD-3-Clause",
      program, program_version());
}

std::optional<ExitCode> parse_arguments(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
    return ExitCode::done;
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}; see {} --help", error.what(), app.get_name()));
  }
  return std::nullopt;
}

CommandLine::CommandLine(const std::string& name, const std::string& description,
                         const std::string& sample_runs)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->footer("Sample runs:\n" + sample_runs);
  app_->set_version_flag("--version", version_line(name));
  // parse() checks the required options, because --schema needs none of them.
  app_->add_option("CASE", case_path_, "case file (.yaml)");
  app_->add_option("--set", set_options_,
                   "change keys of the case, e.g. --set joints.friction=0.3 title=Slippery")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
  app_->add_flag("--check", check_only_, "validate the input and stop");
  app_->add_flag("--inputs", list_inputs_, "print the files that the case reads, one per line, and stop");
  app_->add_flag(
      "--hash", hash_inputs_,
      "print a hash of all keys but sweep and ensemble, and of the files that they name, and stop");
  app_->add_option("--schema", schema_key_,
                   "print every key of the case file, or those of one section: type, unit, range, default")
      ->type_name("[KEY]")
      ->expected(0, 1);
  app_->add_flag("--json", json_, "with --schema: print all keys as a JSON schema, for editors");
  app_->add_flag("--quiet", quiet_, "print warnings and errors only");
  app_->add_flag("--strict", strict_, "treat warnings as errors");
}

CommandLine::~CommandLine() = default;

void CommandLine::required(const std::string& option, std::string* value, const std::string& what,
                           const std::string& help) {
  optional(option, value, what, help + " (required)");
  required_.emplace_back(option, value);
}

void CommandLine::optional(const std::string& option, std::string* value, const std::string& what,
                           const std::string& help) {
  app_->add_option(option, *value, help)->type_name(what);
}

void CommandLine::optional(const std::string& option, int* value, int smallest, const std::string& help) {
  app_->add_option(option, *value, help)->check(CLI::Range(smallest, 1 << 20))->capture_default_str();
}

void CommandLine::flag(const std::string& option, bool* value, const std::string& help) {
  app_->add_flag(option, *value, help);
}

std::optional<ExitCode> CommandLine::parse(int argc, const char* const* argv) {
  const std::vector<const char*> arguments = with_set_before_each_pair(argc, argv);
  if (const auto ended = parse_arguments(*app_, static_cast<int>(arguments.size()), arguments.data()))
    return ended;
  if (json_ && (app_->count("--schema") == 0 || !schema_key_.empty()))
    throw InputError("--json requires --schema, without a key");
  if (app_->count("--schema") > 0) {
    fmt::print("{}", json_ ? case_json_schema() : case_schema(schema_key_));
    return ExitCode::done;
  }
  if (case_path_.empty())
    throw InputError(fmt::format("CASE.yaml is missing; see {} --help", app_->get_name()));
  if (list_inputs_) {
    const std::vector<std::string> inputs = read_case().inputs;
    for (const std::string& file : std::set(inputs.begin(), inputs.end())) fmt::print("{}\n", file);
    return ExitCode::done;
  }
  if (hash_inputs_) {
    fmt::print("{}\n", hash_of_inputs(case_path_, set_options_));
    return ExitCode::done;
  }
  if (check_only_) return std::nullopt;
  for (const auto& [option, value] : required_)
    if (value->empty())
      throw InputError(fmt::format("{} is missing; see {} --help", option, app_->get_name()));
  return std::nullopt;
}

Case CommandLine::read_case() const {
  return cupola::read_case(case_path_, set_options_);
}

void CommandLine::report_warnings(const std::vector<std::string>& warnings,
                                  const std::vector<std::string>& printed_before) const {
  cupola::report_warnings(app_->get_name(), warnings, printed_before, strict_);
}

}  // namespace cupola
