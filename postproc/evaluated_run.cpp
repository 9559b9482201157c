#include "postproc/evaluated_run.hpp"

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/plausibility.hpp"
#include "assembly/case/resolve_thresholds.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/relative_compliance.hpp"
#include "assembly/program/warnings.hpp"

namespace cupola {
namespace {

void check_provenance(const RunInput& input, const Assembly& assembly, const Summary& summary) {
  if (input.force) return;
  if (assembly.geometry_hash != input.scene.geometry_hash)
    throw InputError(FileLocation{input.assembly_path},
                     fmt::format("was generated from another case: geometry or material differ from {}. "
                                 "Generate it again, or pass --force to accept it",
                                 input.scene.file));
  if (summary.case_hash != input.scene.hash)
    throw InputError(FileLocation{input.results_folder},
                     fmt::format("was solved from another case: loads, joints or analysis differ from {}. "
                                 "Solve it again, or pass --force to accept it",
                                 input.scene.file));
}

}  // namespace

EvaluatedRun evaluate_run(const RunInput& input) {
  Assembly assembly = read_assembly(input.assembly_path);
  ResultsReader results(input.results_folder, content_hash(assembly), input.force);
  check_provenance(input, assembly, results.summary());
  Case scene = input.scene;
  resolve_block_names(assembly, &scene.loads, &scene.ties, &scene.supports);
  resolve_compliance(assembly, scene.loads.gravity, &scene.joints.compliance);
  resolve_thresholds(assembly, &scene.analysis.thresholds);
  std::vector<std::string> doubts =
      united({results.summary().warnings, scene.warnings, implausible_for_blocks(scene, assembly)});
  report_warnings("cupola-post", doubts, results.summary().warnings, input.strict);
  Evaluation e = evaluate(scene, std::move(assembly), results, doubts);
  return {std::move(results), std::move(e), std::move(doubts)};
}

}  // namespace cupola
