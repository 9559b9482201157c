// The verdicts of cases/studies/paper.yaml: which statements of the paper the program reproduces and which it
// does not.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "postproc/claims/verdict.hpp"
#include "postproc/studies/study.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::paper_verdicts_test {
namespace {

const std::string kClaims = CUPOLA_SOURCE_DIR "/cases/studies/paper.yaml";

/// Source and statement of the claims that are not reproduced. The page of claims gives the numbers.
const std::set<std::string> kNotReproduced{
    "2.2: Lower compliance leads to faster convergence of the iterative solver.",
    "3.1: Small blocks show numerical instabilities at low compliance.",
    "3.1: At a compliance of 1e-8 m/N per contact the blocks at the base of Brunelleschi's dome settle by 15 "
    "to 20 mm.",
    "3.1: The same for the octagonal vault in planar construction.",
    "3.1: The same for the octagonal vault in circular construction.",
    "3.1: The same for the dome of revolution.",
    "3.2, Fig. 6: The forces are slightly higher in the circular construction because its dome is slightly "
    "thicker.",
    "3.2, Fig. 7: At the top the couple length reaches 0.4 m locally.",
    "3.2, Fig. 7: The same with contacts from GJK under random rotations, as in section 2.3 of the paper, "
    "five seeds.",
    "3.2: The circular arrangement is less sensitive to construction tolerances; tested with the paper's own "
    "imperfection, contacts from GJK under random rotations, five seeds.",
    "3.2: The same with joints randomly opened by up to 0.2 mm, ten seeds.",
    "3.3, Fig. 9a: Despite the symmetry of the circular dome its contact reactions are not evenly "
    "distributed; exact contacts.",
    "3.3, Fig. 10b: With herringbone the couple lengths remain well below 0.2 m.",
    "3.4, Fig. 13: The couple lengths are more irregular than in the circular dome.",
    "3.4, Fig. 13: The couple lengths remain limited.",
    "3.4, Fig. 14b: The sliding of the blocks laid flat is very limited after 2 s.",
    "3.4, Fig. 14c: After 2.5 s a gap separates the spirals from the part above.",
    "3.4, Fig. 14d: After 3 s the spirals have collapsed completely.",
    "3.4: The flat blocks beside the spirals carry less.",
    "3.2, Fig. 8b: The same at the rib.",
};

std::string name_of(const Claim& claim) {
  return claim.source + ": " + claim.says;
}

/// Compares the verdicts of all claims whose runs are finished; returns their number.
int compare_verdicts(const std::string& runs) {
  const std::vector<Claim> claims = read_study(kClaims).claims;
  const std::vector<ClaimResult> results = evaluate_claims(claims, runs);
  int compared = 0;
  for (size_t i = 0; i < claims.size(); ++i) {
    if (results[i].verdict == Verdict::not_run) continue;
    ++compared;
    const Verdict expected =
        kNotReproduced.contains(name_of(claims[i])) ? Verdict::not_reproduced : Verdict::reproduced;
    EXPECT_EQ(to_string(results[i].verdict), to_string(expected))
        << name_of(claims[i]) << "\n  number " << results[i].number.value_or(0.0) << " " << results[i].reason;
  }
  return compared;
}

TEST(PaperVerdicts, ListNamesOnlyClaimsOfTheFile) {
  std::set<std::string> names;
  for (const Claim& claim : read_study(kClaims).claims) EXPECT_TRUE(names.insert(name_of(claim)).second);
  for (const std::string& name : kNotReproduced) EXPECT_TRUE(names.contains(name)) << name;
}

// The claims that read nothing but these six cases, each of which takes about a second.
TEST(PaperVerdicts, OfTheQuickCasesAreAsListed) {
  const ProgramFolder folder;
  for (const std::string name : {"wall_large", "wall_medium", "wall_herringbone", "dome_circular",
                                 "dome_circular_herringbone", "octagon_circular"}) {
    const std::string scene = CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml", run = folder.file(name);
    std::filesystem::create_directories(run);
    const std::string assembly = run + "/assembly.vtu --quiet", results = run + "/results";
    ASSERT_EQ(folder.run("cupola-generate " + scene + " --output " + assembly).code, 0);
    ASSERT_EQ(folder.run("cupola-solve " + scene + " --output " + results + " --assembly " + assembly).code,
              0);
    ASSERT_EQ(folder
                  .run("cupola-post analyse " + scene + " --tables --results " + results + " --output " +
                       run + "/post --assembly " + assembly)
                  .code,
              0);
  }
  EXPECT_GE(compare_verdicts(folder.file("")), 10);
}

// All runs, as `make -f Makefile.cases paper` makes them; five minutes on two cores.
TEST(PaperVerdictsSlow, AreAsListed) {
  const ProgramFolder folder;
  std::string make = "make -C " CUPOLA_SOURCE_DIR " -f Makefile.cases --jobs=2 BUILD=" CUPOLA_BIN_DIR
                     "/.. OUT=" +
                     folder.file("out");
  for (const char* program : {"generate", "solve", "post"})  // they are built: make must not build them again
    make += std::string(" -o " CUPOLA_BIN_DIR "/../bin/cupola-") + program;
  const ProgramRun run = folder.run(make + " paper");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(compare_verdicts(folder.file("out")), static_cast<int>(read_study(kClaims).claims.size()));
}

}  // namespace
}  // namespace cupola::paper_verdicts_test
