// cupola-solve: contact forces and motion of an assembly of rigid blocks.
//
// Sample runs:
//   cupola-solve cases/dome_circular.yaml --assembly assembly.vtu --output results/
//   cupola-solve cases/dome_circular.yaml --assembly assembly.vtu --output low/ --set joints.friction=0.2
//   cupola-solve cases/dome_circular.yaml --assembly assembly.vtu --explain
//   cupola-solve cases/dome_circular_dynamic.yaml --assembly assembly.vtu --output results/ --resume

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/key_places.hpp"
#include "assembly/program/batch.hpp"
#include "assembly/program/command_line.hpp"
#include "solver/runtime/blas_kernels.hpp"
#include "solver/solve_case.hpp"

namespace {

using namespace cupola;

PreparedRun prepare(int argc, char** argv) {
  // 1. Command line
  SolveRequest request;
  bool explain = false;
  CommandLine line("cupola-solve", "Finds the contact forces and the motion of an assembly of rigid blocks.",
                   "  cupola-solve dome.yaml --assembly assembly.vtu --output results/\n"
                   "  cupola-solve dome.yaml --assembly assembly.vtu --explain");
  line.required("--assembly", &request.assembly_path, "FILE",
                "assembly that cupola-generate wrote for the case");
  line.optional("--output", &request.output_folder, "FOLDER", "results folder to write");
  line.flag("--explain", &explain, "print the model, its cost and the active features without solving it");
  line.flag("--force", &request.force, "use an assembly that was made from another geometry or material");
  line.flag("--resume", &request.resume, "resume from the checkpoint in the output folder, if there is one");
  line.flag("--verbose", &request.verbose,
            "print every step, trial and iteration, and all residuals at the end");
  line.optional("--threads", &request.threads, 1,
                "number of threads (default 1); the results are the same to the bit");
  if (const auto ended = line.parse(argc, argv)) return [code = *ended] { return code; };

  // 2. The case
  request.scene = line.read_case();
  request.quiet = line.quiet();
  request.strict = line.strict();
  if (line.check_only()) {
    line.report_warnings(request.scene.warnings);
    return [] { return ExitCode::done; };
  }

  // 3. Explain or solve
  if (explain)
    return [request] {
      fmt::print("{}", with_places_of_keys(request.scene, [&] { return explain_case(request); }));
      return ExitCode::done;
    };
  if (request.output_folder.empty()) throw InputError("--output is missing; see cupola-solve --help");
  return [request] { return with_places_of_keys(request.scene, [&] { return solve_case(request); }); };
}

}  // namespace

int main(int argc, char** argv) {
  cupola::use_kernels_of_processor(argv);
  return run_program("cupola-solve", argc, argv, prepare);
}
