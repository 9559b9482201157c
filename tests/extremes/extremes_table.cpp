// Writes the table of extreme scenes: the exact answer, how the run ended, its true error beside the accuracy
// that it states, iterations, time and verdict of every row.
//
//   extremes_table FOLDER [TEXT]      writes extremes.csv and extremes.md to the folder; with TEXT only the
//                                     rows whose group or name contains it. Exit code 1 if a row is worse
//                                     than known.

#include <cmath>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/program.hpp"
#include "tests/arguments.hpp"
#include "tests/extremes/extreme_scene.hpp"
#include "tests/extremes/known_verdicts.hpp"

namespace {

using namespace cupola;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return out + "\"";
}

std::string cell(double value) {
  return std::isnan(value) ? "" : fmt::format("{:.0e}", value);
}

std::string csv_row(const ExtremeScene& scene, const ExtremeResult& r) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{:.3f},{},{},{}\n", quoted(scene.group), quoted(scene.name),
                     quoted(scene.reference), to_string(r.ending), r.error.largest, r.error.wrench, r.asked,
                     quoted(r.stated), r.iterations, r.seconds, to_string(r.verdict), quoted(r.reason),
                     quoted(r.message));
}

std::string markdown_row(const ExtremeScene& scene, const ExtremeResult& r) {
  std::string verdict = to_string(r.verdict);
  if (r.ending == Ending::timeout) verdict = r.message;
  if (r.verdict == Verdict::wrong) verdict += ": " + r.reason;
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.2f} | {} |\n", scene.group, scene.name,
                     scene.reference, to_string(r.ending), cell(r.error.largest), r.stated, r.iterations,
                     r.seconds, verdict);
}

ExitCode write_table(const std::string& folder, const std::string& text) {
  std::string csv =
      "group,scene,exact_answer,ended,true_error,wrench_error,asked,stated,iterations,cpu_time_s,verdict,"
      "reason,message\n";
  std::string markdown = fmt::format(
      "Written by `make -f Makefile.cases extremes`, Cupola {}. docs/data/extremes.md explains the "
      "columns.\n\n"
      "| group | what is hard | exact answer | ended | true error | stated | iterations | CPU s | verdict "
      "|\n|---|---|---|---|---|---|---|---|---|\n",
      program_version());
  std::array<int, 3> count{};
  int worse = 0;
  for (const ExtremeScene& scene : extreme_scenes()) {
    if ((scene.group + " " + scene.name).find(text) == std::string::npos) continue;
    const ExtremeResult r = run_extreme(scene);
    ++count[static_cast<size_t>(r.verdict)];
    worse += r.verdict > known_verdict(scene.group, scene.name);
    csv += csv_row(scene, r);
    markdown += markdown_row(scene, r);
    fmt::print("{}", markdown_row(scene, r));
    std::fflush(stdout);
  }
  const std::string sum = fmt::format("{} rows: {} right, {} not met, {} WRONG",
                                      count[0] + count[1] + count[2], count[0], count[1], count[2]);
  make_folder(folder);
  write_text_atomically(folder + "/extremes.csv", csv);
  write_text_atomically(folder + "/extremes.md", markdown + "\n" + sum + "\n");
  fmt::print("{}; {} worse than known. The table is in {}/extremes.md\n", sum, worse, folder);
  return worse == 0 ? ExitCode::done : ExitCode::failed;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("extremes_table", [&] {
    const auto arguments = read_arguments(argc, argv, 1, 2, "extremes_table FOLDER [TEXT]");
    return write_table(arguments[0], arguments.size() > 1 ? arguments[1] : "");
  });
}
