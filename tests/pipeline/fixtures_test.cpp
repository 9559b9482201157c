// Results folders written by earlier versions: they are read and evaluated for ever. Each folder of
// tests/fixtures/VERSION is one run (case.yaml, results/) of the assembly arch.vtu or wall.vtu beside it.

#include "assembly/case/case_reader.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "postproc/evaluation/evaluation.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola {
namespace {

struct OldRun {
  const char* version;
  const char* name;
  const char* assembly;
  AnalysisType analysis;
  Status status;
  std::vector<FrameRole> roles;
};

std::ostream& operator<<(std::ostream& out, const OldRun& run) {
  return out << run.version << '/' << run.name;
}

class Fixtures : public ::testing::TestWithParam<OldRun> {
 protected:
  static std::string versions() { return CUPOLA_SOURCE_DIR "/tests/fixtures/"; }
  std::string file(const char* name) const { return versions() + GetParam().version + "/" + name; }
  std::string folder() const { return file(GetParam().name); }
};

TEST_P(Fixtures, AreRead) {
  const OldRun& run = GetParam();
  const Assembly assembly = read_assembly(file(run.assembly));
  const ResultsReader results(folder() + "/results", content_hash(assembly));
  EXPECT_EQ(results.summary().analysis, run.analysis);
  EXPECT_EQ(results.summary().status, run.status);
  ASSERT_EQ(results.times().size(), run.roles.size());
  for (size_t i = 0; i < run.roles.size(); ++i) {
    const Frame frame = results.read_frame(static_cast<int>(i));
    EXPECT_EQ(frame.blocks.position.size(), assembly.blocks.size());
    EXPECT_GT(frame.contacts.size(), 0);
    EXPECT_EQ(to_string(frame.role), to_string(run.roles[i]));
    EXPECT_FALSE(frame.label.empty());
  }
  for (const auto& [name, hash] : results.summary().text_files)
    EXPECT_FALSE(results.read_text_file(name).empty()) << name;
}

TEST_P(Fixtures, AreInEquilibriumWhereTheyStand) {
  const OldRun& run = GetParam();
  const ResultsReader results(folder() + "/results", content_hash(read_assembly(file(run.assembly))));
  const Evaluation e =
      evaluate(read_case(folder() + "/case.yaml"), read_assembly(file(run.assembly)), results);
  EXPECT_EQ(at_rest(e), run.status == Status::stable);
  if (!at_rest(e)) return;
  EXPECT_FALSE(e.rings.empty());
  for (const RingSum& ring : e.rings)
    if (ring.blocks > 0) {
      EXPECT_LT(ring.relative_difference, 1e-4);  // ten times the loosest tolerance of the solver
    }
}

// --force: the hash of a case may change with the keys that later versions add.
TEST_P(Fixtures, AreEvaluated) {
  const ProgramFolder post;
  const ProgramRun done =
      post.run("cupola-post analyse " + folder() + "/case.yaml --assembly " + file(GetParam().assembly) +
               " --results " + folder() + "/results --output post --force --tables --quiet");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(std::filesystem::exists(post.file("post/summary.json")));
}

using enum FrameRole;
INSTANTIATE_TEST_SUITE_P(
    OfVersion, Fixtures,
    ::testing::Values(
        OldRun{"0.2", "static", "arch.vtu", AnalysisType::static_, Status::stable, {equilibrium}},
        OldRun{"0.2", "moving", "arch.vtu", AnalysisType::static_, Status::moving, {mechanism}},
        OldRun{"0.2", "dynamic", "arch.vtu", AnalysisType::dynamic, Status::moving, {step, step}},
        OldRun{"0.2", "limit", "arch.vtu", AnalysisType::limit, Status::stable, {equilibrium, mechanism}},
        OldRun{"0.2",
               "range",
               "arch.vtu",
               AnalysisType::range,
               Status::stable,
               {equilibrium, range_end, range_end}},
        OldRun{"0.2", "path", "arch.vtu", AnalysisType::path, Status::stable, {path, path}},
        OldRun{"0.2", "staged", "wall.vtu", AnalysisType::staged, Status::stable, {stage, stage}},
        OldRun{"0.2", "carried", "wall.vtu", AnalysisType::staged, Status::stable, {stage, stage}}),
    [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace cupola
