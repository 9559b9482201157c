// cupola-generate: cuts a case's vault into rigid blocks and checks them.
//
// Sample runs:
//   cupola-generate cases/dome_circular.yaml --output assembly.vtu
//   cupola-generate cases/dome_circular.yaml --output thin.vtu --set geometry.surface.thickness=1.1

#include <filesystem>

#include <fmt/format.h>

#include "assembly/assembly_file.hpp"
#include "assembly/atomic_file.hpp"
#include "assembly/command_line.hpp"
#include "generators/generate.hpp"

namespace {

using namespace cupola;

ExitCode generate_assembly(int argc, char** argv) {
  // 1. What is asked
  std::string output;
  CommandLine line("cupola-generate", "Cuts a case's vault into rigid blocks and checks them.",
                   "  cupola-generate dome.yaml --output assembly.vtu\n"
                   "  cupola-generate dome.yaml --output thin.vtu --set geometry.surface.thickness=1.1");
  line.required("--output", &output, "FILE", "assembly to write (.vtu)");
  if (const auto ended = line.parse(argc, argv)) return *ended;

  // 2. The case
  const Case scene = line.read_case();
  if (line.check_only()) return ExitCode::done;

  // 3. The blocks, checked
  ModelReport report;
  const Assembly assembly = generate(scene, &report);
  if (!line.quiet()) fmt::print("{}", to_text(report));

  // 4. The file
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  if (!folder.empty()) make_folder(folder.string());
  write_assembly(output, assembly);
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("cupola-generate", [&] { return generate_assembly(argc, argv); });
}
