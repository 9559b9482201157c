#pragma once

#include "assembly/files/content_hash.hpp"
#include "generators/generate.hpp"
#include "postproc/evaluation/evaluation.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola {

/// The last frame of a static case that must be stable.
inline Frame solve_to_rest(const Case& scene, const Assembly& assembly, Summary* summary) {
  Frame last;
  *summary = run_static(
      scene, assembly,
      {[&](const Frame& frame) { last = frame; }, [](const std::string&) {}, [](const std::string&) {}});
  EXPECT_EQ(summary->status, Status::stable) << summary->message;
  return last;
}

/// Generates, solves and evaluates a static case, with its results in the folder.
inline Evaluation solve_and_evaluate(const Case& scene, const ProgramFolder& folder) {
  const Assembly assembly = generate(scene);
  ResultsWriter writer(folder.file("results"), content_hash(assembly));
  Summary summary = run_static(scene, assembly,
                               {[&writer](const Frame& frame) { writer.write_frame(frame); },
                                [](const std::string&) {}, [](const std::string&) {}});
  summary.assembly_hash = content_hash(assembly);
  writer.write_summary(summary);
  return evaluate(scene, assembly, ResultsReader(folder.file("results"), content_hash(assembly)));
}

}  // namespace cupola
