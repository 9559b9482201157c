// Prints the table of extreme scenes: expected result, ending, accuracy requested and reached, time and
// verdict of every row.
//
//   extremes_table FOLDER      writes extremes.csv and extremes.md to the folder; exit code 1 if a row fails

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/program.hpp"
#include "tests/extremes/extreme_scene.hpp"

namespace {

using namespace cupola;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return out + "\"";
}

std::string number(double value, bool refused) {
  return refused ? "-" : fmt::format("{:.1e}", value);
}

ExitCode print_table(const std::string& folder) {
  std::string csv = "group,scene,expected,ended,asked,reached,cpu_time_s,verdict,message\n";
  std::string markdown =
      "| group | scene | expected | ended | requested | reached | CPU s | verdict "
      "|\n|---|---|---|---|---|---|---|---|\n";
  int failed = 0;
  for (const ExtremeScene& scene : extreme_scenes()) {
    const ExtremeResult r = run_extreme(scene);
    const bool refused = r.ending == Ending::refused;
    const std::string verdict = r.fault.empty() ? "passed" : "FAILED: " + r.fault;
    failed += !r.fault.empty();
    csv += fmt::format("{},{},{},{},{},{},{:.3f},{},{}\n", quoted(scene.group), quoted(scene.name),
                       quoted(scene.expected), to_string(r.ending), r.asked, r.reached, r.seconds,
                       quoted(verdict), quoted(r.message));
    const std::string row = fmt::format(
        "| {} | {} | {} | {} | {} | {} | {:.2f} | {} |\n", scene.group, scene.name, scene.expected,
        to_string(r.ending), number(r.asked, refused), number(r.reached, refused), r.seconds, verdict);
    markdown += row;
    fmt::print("{}", row);
    std::fflush(stdout);
  }
  make_folder(folder);
  write_text_atomically(folder + "/extremes.csv", csv);
  write_text_atomically(folder + "/extremes.md", markdown);
  fmt::print("{} of {} rows failed; the table is in {}/extremes.md\n", failed, extreme_scenes().size(),
             folder);
  return failed == 0 ? ExitCode::done : ExitCode::failed;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("extremes_table", [&] {
    if (argc != 2) throw InputError("usage: extremes_table FOLDER");
    return print_table(argv[1]);
  });
}
