// Vaults that were drawn elsewhere (cases/cross_vault.yaml, cases/pavilion_vault.yaml). The geometry decides
// whether they stand, not the stiffness of the joints.

#include "tests/pipeline/program_run.hpp"

namespace cupola::public_vaults_test {
namespace {

ProgramRun solve(const ProgramFolder& folder, const std::string& name, const std::string& options) {
  const std::string path = CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml";
  if (!std::filesystem::exists(folder.file("a.vtu"))) {
    EXPECT_EQ(folder.run("cupola-generate " + path + " --output a.vtu").code, 0);
  }
  return folder.run("cupola-solve " + path + " --assembly a.vtu --output results " + options);
}

// Shear is 2.4 times softer throughout, as by default. Joints 240 times softer along than across, which the
// default for one and 1e-12 for the other would give, are those of no material.
TEST(PublicVaults, TheCrossVaultStandsWhateverTheStiffnessOfItsJoints) {
  const ProgramFolder folder;
  for (const char* compliance :
       {"{normal: 1e-9, tangential: 2.4e-9, per: area}", "{normal: 1e-10, tangential: 2.4e-10, per: area}",
        "{normal: 1e-12, tangential: 2.4e-12, per: area}"})
    for (const char* law : {"associated", "coulomb"}) {
      const ProgramRun run =
          solve(folder, "cross_vault",
                fmt::format("--set analysis.friction_law={} --set 'joints.compliance={}'", law, compliance));
      EXPECT_EQ(run.code, 0) << run.err;
      EXPECT_NE(run.out.find("it stands: "), std::string::npos)
          << law << ", " << compliance << ": " << run.out;
    }
}

// Both ends of the bracket are proven; 0.001 covers the snapping of its corners, which the file states to
// three digits: 0.41887 with their gaps closed, 0.41887 as they are.
TEST(PublicVaults, TheCrossVaultNeedsAFrictionOfTwoFifths) {
  const ProgramFolder folder;
  solve(
      folder, "cross_vault",
      "--set analysis.type=limit --set analysis.limit.parameter=friction --set analysis.limit.low=0.05 --set "
      "analysis.limit.high=1");
  const std::string summary = slurp(folder.file("results/summary.json"));
  const size_t at = summary.find("\"critical_value\":");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::strtod(summary.c_str() + at + 17, nullptr), 0.419, 1e-3);
}

// 4 % above that friction the first steps of a path slide far before they come to rest. Followed to there they
// take 1000 iterations; sought from the solution under the associated law they took 4600.
TEST(PublicVaults, PathsOfTheCrossVaultAreFollowedWhileItSlides) {
  const ProgramFolder folder;
  const ProgramRun run =
      solve(folder, "cross_vault",
            "--set analysis.type=path analysis.friction_law=coulomb 'analysis.path={steps: 3, end: 0.1}' "
            "'loads.dead_load_time={type: ramp}' joints.friction=0.435");
  EXPECT_NE(run.out.find("it stands: 4 equilibria up to 0.1 s"), std::string::npos) << run.out << run.err;
  const std::string summary = slurp(folder.file("results/summary.json"));
  const size_t at = summary.find("\"iterations\":");
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(std::strtol(summary.c_str() + at + 13, nullptr, 10), 2000);
}

TEST(PublicVaults, ThePavilionVaultStands) {
  const ProgramFolder folder;
  const ProgramRun run = solve(folder, "pavilion_vault", "");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("it stands: "), std::string::npos) << run.out;
}

}  // namespace
}  // namespace cupola::public_vaults_test
