// A plane wall solved in the plane has the same resultants as in space, with half the unknowns.

#include <map>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/test_names.hpp"

namespace cupola::plane_test {
namespace {

struct Solved {
  Summary summary;
  Frame frame;
};

Solved solve(const Case& input, const Assembly& assembly) {
  Solved solved;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { solved.frame = frame; };
  solved.summary = run_analysis(input, assembly, sinks).value();
  return solved;
}

Solved solve_case(const std::string& name, std::vector<std::string> settings) {
  const Case input = read_case(CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml", settings);
  return solve(input, generate(input));
}

// Both bounds of the largest push on this wall are the same number; the ends of its bracket still tell which
// side stands.
TEST(Plane, TheEndsOfALimitDiffer) {
  const CriticalValue critical = solve_case("wall_griffith", {}).summary.critical.value();
  EXPECT_LT(critical.stable, critical.moving);
  EXPECT_NEAR(critical.value, 2.0 * 0.11 / 1.5, 1e-5 * critical.value) << "the width of the bracket";
}

struct Resultant {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // N, N m about the origin
};

std::map<std::pair<int, int>, Resultant> resultants(const Frame& frame) {
  std::map<std::pair<int, int>, Resultant> sums;
  const ContactTable& c = frame.contacts;
  for (int i = 0; i < c.size(); ++i) {
    Resultant& sum = sums[{c.block_a[i], c.block_b[i]}];
    sum.force += c.force[i];
    sum.moment += c.point[i].cross(c.force[i]);
  }
  return sums;
}

/// Largest difference of a joint resultant, over the largest resultant.
double difference(const Solved& space, const Solved& plane) {
  const auto p = resultants(space.frame), q = resultants(plane.frame);
  EXPECT_EQ(p.size(), q.size());
  double largest = 0.0, error = 0.0;
  for (const auto& [pair, sum] : p) {
    largest = std::max(largest, sum.force.norm());
    error = std::max(error, (q.at(pair).force - sum.force).norm());
    error = std::max(error, (q.at(pair).moment - sum.moment).norm() / 10.0);  // walls of about 10 m
  }
  return error / largest;
}

class PlaneWall : public ::testing::TestWithParam<std::vector<std::string>> {};

TEST_P(PlaneWall, HasTheSameResultantsAsInSpace) {
  std::vector<std::string> settings = GetParam();
  const Solved space = solve_case("wall_medium", settings);
  settings.push_back("analysis.plane=true");
  const Solved plane = solve_case("wall_medium", settings);
  ASSERT_EQ(space.summary.status, plane.summary.status) << plane.summary.message;
  EXPECT_EQ(2 * plane.summary.unknowns, space.summary.unknowns);
  EXPECT_LT(plane.summary.contacts, space.summary.contacts);
  // Both are in equilibrium to 1e-8 of a block weight; stiff joints in parallel amplify the difference.
  EXPECT_LT(difference(space, plane), 1e-6);
  EXPECT_NEAR(*plane.summary.max_displacement_m / *space.summary.max_displacement_m, 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Walls, PlaneWall,
    ::testing::Values(std::vector<std::string>{}, std::vector<std::string>{"joints.compliance.per=area"},
                      std::vector<std::string>{"loads.gravity=[2, 0, -9.81]"},
                      std::vector<std::string>{"analysis.friction_law=coulomb", "loads.gravity=[2, 0, -9.81]",
                                               "analysis.tolerance=1e-7"},
                      std::vector<std::string>{"analysis.type=dynamic", "analysis.duration=0.05",
                                               "analysis.tolerance=1e-9"}),
    test_names({"PerPoint", "PerArea", "Leaning", "LeaningCoulomb", "Moving"}));

TEST(PlaneScene, RefusesScenesThatAreNotPlane) {
  const auto message = [](const std::string& name, const std::vector<std::string>& settings) {
    try {
      solve_case(name, settings);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("dome_circular", {"analysis.plane=true", "geometry.bond.rings=3"}).find("not symmetric"),
            std::string::npos);
  EXPECT_NE(message("wall_large", {"analysis.plane=true", "loads.gravity=[0, 1, -9.81]"}).find("gravity"),
            std::string::npos);
  EXPECT_NE(
      message("wall_large", {"analysis.plane=true", "contact.method=perturbed_gjk"}).find("face_clipping"),
      std::string::npos);
}

}  // namespace
}  // namespace cupola::plane_test
