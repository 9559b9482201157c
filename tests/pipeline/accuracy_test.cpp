// `accuracy: {wrench_error: ...}`: certified errors hold against a reference, and each preset stays within
// its documented error.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/wrench_error.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola::accuracy_test {
namespace {

/// A case with everything that a static solve needs.
struct StaticScene {
  Case input;
  Assembly assembly;
  Model model;
  State rest;
  ContactSet contacts;
  ContactMemories memories;

  StaticScene(const std::string& name, const std::vector<std::string>& settings)
      : input(read_case(CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml", settings)),
        assembly(generate(input)),
        model(make_model(input, assembly)),
        rest(state_at_rest(model)),
        contacts(ContactDetector(assembly, detection_options(input)).update(rest.poses)),
        memories(match_memories({}, contacts.points)) {}

  StaticSolution solve(double tolerance) const {
    StaticOptions options;
    options.tolerance = tolerance;
    options.solve.law = input.analysis.friction_law;
    return solve_static(model, rest, contacts, memories, options);
  }
  StaticSolution solve_to(double wrench_error, double* reached,
                          ContactMethod method = ContactMethod::newton) const {
    StaticOptions options;
    options.solve.law = input.analysis.friction_law;
    options.solve.method = method;
    return solve_static_to_wrench_error(model, rest, contacts, memories, options, wrench_error, reached);
  }
};

const std::vector<std::string> kSmallDome{"geometry.bond.rings=12", "geometry.bond.blocks_per_ring=16"};

TEST(WrenchError, CertifiedErrorHoldsAgainstAReference) {
  const StaticScene dome("dome_circular", kSmallDome);
  const StaticSolution exact = dome.solve(1e-11);
  for (const double requested : {1e-1, 1e-2, 1e-3, 1e-5}) {
    double reached = 0.0;
    const StaticSolution solution = dome.solve_to(requested, &reached);
    ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
    EXPECT_LE(reached, requested);
    EXPECT_NE(solution.message.find("certified"), std::string::npos) << solution.message;
    EXPECT_LE(compared_wrench_error(dome.contacts, solution, exact), requested);
  }
}

TEST(WrenchError, CertificateBoundsTheErrorOfAFirstOrderMethod) {
  const StaticScene dome("dome_circular", kSmallDome);
  StaticOptions options;
  options.tolerance = 1e-2;
  options.solve.method = ContactMethod::admm;
  const StaticSolution rough = solve_static(dome.model, dome.rest, dome.contacts, dome.memories, options);
  const std::optional<double> bound = certified_wrench_error(dome.contacts, rough);
  ASSERT_TRUE(bound);
  // The certificate holds for the problem at this h: compare with Newton's solution of the same problem.
  ContactSolverOptions tight;
  tight.tolerance = 1e-12;
  tight.reference_speed = rough.h * 9.81;
  StaticSolution same = rough;
  same.step_solution = {};
  solve_contact(rough.step.problem, tight, &same.step_solution);
  same.forces = joint_forces(dome.contacts, same.step_solution.gamma, rough.h);
  EXPECT_LE(compared_wrench_error(dome.contacts, rough, same), *bound);
  EXPECT_GT(compared_wrench_error(dome.contacts, rough, same), 0.0);
}

TEST(WrenchError, IsMeasuredInsteadOfCertifiedUnderCoulombsLaw) {
  std::vector<std::string> settings = kSmallDome;
  settings.push_back("analysis.friction_law=coulomb");
  const StaticScene dome("dome_circular", settings);
  double reached = 0.0;
  const StaticSolution solution = dome.solve_to(1e-2, &reached);
  ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
  EXPECT_NE(solution.message.find("no certificate exists"), std::string::npos) << solution.message;
  EXPECT_LE(reached, 1e-2);
}

TEST(WrenchError, IsZeroBetweenASolutionAndItself) {
  const StaticScene dome("dome_circular", kSmallDome);
  const StaticSolution exact = dome.solve(1e-8);
  EXPECT_EQ(compared_wrench_error(dome.contacts, exact, exact), 0.0);
}

/// Each static case of the paper.
class AccuracyPresetSlow : public ::testing::TestWithParam<const char*> {};

/// The error of `accuracy: standard`, documented in docs/accuracy.md.
constexpr double kStandardError = 1e-4;

TEST_P(AccuracyPresetSlow, StandardIsWithinItsDocumentedWrenchError) {
  const StaticScene scene(GetParam(), {});
  const double standard = read_case(scene.input.file, {"analysis.accuracy=standard"}).analysis.tolerance;
  const StaticSolution solution = scene.solve(standard);
  ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
  const StaticSolution exact = scene.solve(1e-9);
  ASSERT_EQ(exact.outcome, StaticOutcome::equilibrium) << exact.message;
  const double error = compared_wrench_error(scene.contacts, solution, exact);
  RecordProperty("wrench_error", fmt::format("{:.1e}", error));
  EXPECT_LE(error, kStandardError);
}

INSTANTIATE_TEST_SUITE_P(Paper, AccuracyPresetSlow,
                         ::testing::Values("wall_large", "wall_medium", "wall_small", "wall_herringbone",
                                           "dome_circular", "dome_circular_herringbone", "octagon_planar",
                                           "octagon_circular", "brunelleschi"));

}  // namespace
}  // namespace cupola::accuracy_test
