#include <cmath>

#include "solver/analysis/path_row.hpp"
#include "tests/solver/analysis/path_run.hpp"

// Joints with strength that open, close and open again along a path.

namespace cupola::path_test {
namespace {

// A joint opened to half of its damage, closed again and opened again: it closes without force until its
// faces touch, pushes elastically, and pulls again from where it stopped, with half of its strength.
TEST(Path, ACrackClosesAndOpensAgain) {
  Case scene = couplet_case(60);
  const double broken = 2.0 * kEnergy.tension / kStrength.tension;
  scene.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                  .displacement = {0, 0, 0.5 * broken},
                                  .time = TableInTime{"", {0, 1, 2, 3}, {0, 1, -0.01, 1.5}}});
  scene.analysis.path.end = 3.0;
  scene.analysis.path.control->direction = Vec3::UnitZ();
  const PathResult result = run(scene, couplet());
  ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
  const double pull = kStrength.tension * kArea;
  double at_one = 0.0, closed = 0.0, reopened = 0.0, halfway = 0.0;
  for (const auto& row : result.rows) {
    if (std::abs(row[0] - 1.0) < 1e-6) at_one = row[2];
    if (std::abs(row[0] - 1.5) < 1e-6) halfway = row[2];
    if (std::abs(row[0] - 2.0) < 1e-6) closed = row[2];
    if (row[0] > 2.0) reopened = std::max(reopened, row[2]);
  }
  // The strength is the mean over the last of 20 steps to half the opening, less the elongation of three
  // joints.
  const double elastic = 3 * kCompliance * kStrength.tension / broken;
  EXPECT_NEAR(at_one, (0.5 + 0.5 * 0.5 / 20) / (1 - elastic) * pull + kWeight, 0.003 * pull);
  EXPECT_NEAR(halfway, kWeight, 1e-3 * kWeight);
  EXPECT_NEAR(closed, kWeight - 0.005 * broken / (3 * kCompliance) * kArea, 1e-3 * pull);
  EXPECT_NEAR(reopened, 0.5 * pull, 0.05 * pull);
  for (size_t k = 1; k < result.rows.size(); ++k) EXPECT_GE(result.rows[k][3], result.rows[k - 1][3] - 1e-9);
}

// A block of 1 x 1 x 2 m and 40 kN is pushed at its top by 6 kN to one side, then to the other in one step; it
// tips at 10 kN. The bed opens on one side, and bears there again: with a strength of 1 Pa as without.
TEST(Path, AnOpenedJointWithTensileStrengthBearsWhenItCloses) {
  for (const double tension : {0.0, 1.0, 100.0}) {
    Case scene = testing::make_case(0.6, 1e-11, 0.01);
    scene.joints.strength = {tension, 1e4};
    scene.contact.subdivide = 4;
    const Assembly block = testing::box_on_floor({1, 1, 2}, 20e3 / 9.81);
    const TableInTime time{"", {0, 1, 1.000001, 2}, {0, 1, -1, -1}};
    scene.loads.forces = {{BlockRef{1}, Vec3(0, 0, 2), Vec3(6e3, 0, 0), time}};
    scene.analysis.type = AnalysisType::path;
    scene.analysis.path.end = 2.0;
    scene.analysis.path.steps = 4;
    scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
    const PathResult result = run(scene, block);
    EXPECT_EQ(result.summary.status, Status::stable) << tension << ": " << result.summary.message;
  }
}

// Opened by a support, closed and opened again, in steps that each pass from closed to beyond where the crack
// stopped opening: a plastic joint pulls with its whole strength again, and yields no further.
TEST(Path, ACrackThatOpensAgainInOneStepPulls) {
  const double opening = 1e-3;  // m
  for (const int steps : {3, 30}) {
    Case scene = couplet_case(steps);
    scene.joints.failure = JointFailure::plastic;
    scene.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                    .displacement = {0, 0, opening},
                                    .time = TableInTime{"", {0, 1, 2, 3}, {0, 1, 0, 1}}});
    scene.analysis.path.end = 3.0;
    scene.analysis.path.control->direction = Vec3::UnitZ();
    const PathResult result = run(scene, couplet());
    ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
    const std::vector<double>&first = result.rows[steps / 3], &again = result.rows.back();
    const double pull = kStrength.tension * kArea;
    EXPECT_NEAR(first[2], pull + kWeight, 1e-3 * pull) << steps;
    EXPECT_NEAR(again[2], first[2], 1e-5 * pull) << steps << ": the tolerance of the path";
    EXPECT_NEAR(again[3], first[3], 1e-5 * first[3]) << steps << ": it yields once";
  }
}

/// A cube of 1 m and 10 kN on a plastic bed of 0.1 MPa, pulled upwards near its edge by a force with the given
/// multiples of 10 kN at the times 0 to 3 s.
Case pulled_cube(const std::vector<double>& pulls) {
  Case scene = testing::make_case(0.6, 0.0, 0.01);
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.joints.strength = {.tension = 1e5, .cohesion = 4e5};
  scene.contact.subdivide = 4;
  scene.contact.margin = 2e-2;  // m
  scene.loads.forces = {
      {BlockRef{1}, Vec3(0.4, 0, 1), Vec3(0, 0, 1e4), TableInTime{"", {0, 1, 2, 3}, pulls}}};
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.path.end = 3.0;
  scene.analysis.path.steps = 60;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitZ()};
  return scene;
}

// Pulled to 60 kN, pressed and pulled again, the bed bears the 60 kN that it bore: points that a motion opens
// pull, and a fall is proven only where none that opens or closes would resist it.
TEST(Path, BearsAgainWhatItBore) {
  const Assembly cube = testing::box_on_floor({1, 1, 1}, 1e4 / testing::kG);
  const PathResult again = run(pulled_cube({0, 6, -1, 5.9}), cube);
  EXPECT_EQ(again.summary.status, Status::stable) << again.summary.message;
  EXPECT_EQ(again.rows.back()[0], 3.0);
  const PathResult once = run(pulled_cube({0, 6, 12, 12}), cube),
                   twice = run(pulled_cube({0, 6, -1, 12}), cube);
  for (const PathResult* falls : {&once, &twice})
    EXPECT_EQ(falls->summary.status, Status::moving) << falls->summary.message;
  // Of a regular step the shortest is a 64th.
  EXPECT_NEAR(twice.largest_force(), once.largest_force(), 1e4 * 13.0 / 20 / 64 * 2);
}

// Points between the faces of a crack that closes carry nothing, and count for the widest gap.
TEST(Path, PointsThatAreClosingCarryNothing) {
  const PathResult result =
      run(pulled_cube({0, 5, -1, 4}), testing::box_on_floor({1, 1, 1}, 1e4 / testing::kG));
  ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
  for (size_t k = 0; k < result.frames.size(); ++k) {
    const ContactTable& contacts = result.frames[k].contacts;
    double widest = 0.0;
    for (int i = 0; i < contacts.size(); ++i) {
      const double n = contacts.normal_force[i];
      EXPECT_TRUE(n == 0.0 || std::abs(n) > 1e-100) << n << " N at " << result.rows[k][0] << " s";
      if (!(n > 1e-100)) widest = std::max(widest, contacts.crack_opening[i]);
    }
    EXPECT_NEAR(result.rows[k][6], widest, 1e-8 * widest) << "nine digits in the table";
  }
}

TEST(PathRow, ForcesOfRoundingCloseNoGap) {
  ContactTable contacts;
  contacts.joint = {0, 0, 0};
  contacts.gap = {1e-3, 2e-3, 3e-3};
  contacts.normal_force = {0.0, 1e-19, 1e4};
  EXPECT_EQ(widest_gap(contacts), 2e-3);
}

}  // namespace
}  // namespace cupola::path_test
