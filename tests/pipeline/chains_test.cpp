// Chains from the case to the tables: what the generator places, the solver loads and the postprocessor sums.

#include <numbers>

#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::chains_test {
namespace {

using std::numbers::pi;

Case hemisphere(double crown_angle_deg, int rings) {
  Case scene;
  DomeSurface dome;
  dome.span = 20.0;
  dome.radius_ratio = 0.5;
  dome.thickness = 1.5;
  dome.crown_angle_deg = crown_angle_deg;
  scene.geometry.surface = dome;
  scene.geometry.bond = StackBond{rings, 16, 4};
  scene.joints.base.emplace().friction = 0.0;
  Chain chain;
  chain.name = "iron";
  chain.course = 0;
  chain.axial_stiffness = 5e9;
  scene.geometry.chains = {chain};
  return scene;
}

// A ring without friction at its base, pressed outwards: H per length gives T = H r. The facets of the
// intrados reach from the radius rho_0 to rho_1 over the height dz, so that H r = p dz (rho_0 + rho_1) / 2.
TEST(Chain, CarriesTheThrustOfARingTimesItsRadius) {
  const ProgramFolder folder;
  Case scene = hemisphere(5.0, 1);
  const double p = 2000.0, crown = 5.0 * pi / 180.0;
  FaceLoad outward;
  outward.faces = FaceKind::intrados;
  outward.pressure = p;
  scene.loads.faces = {outward};
  const Evaluation e = solve_and_evaluate(scene, folder);
  ASSERT_EQ(e.summary.status, Status::stable) << e.summary.message;
  ASSERT_EQ(e.chains.size(), 1u);
  const double T = p * 10.0 * std::sin(crown) * 10.0 * (1.0 + std::cos(crown)) / 2.0;
  EXPECT_EQ(e.chains[0].name, "iron");
  EXPECT_EQ(e.chains[0].bars, 16);
  EXPECT_NEAR(e.chains[0].mean / T, 1.0, 1e-6);
  EXPECT_NEAR(e.chains[0].least / T, 1.0, 1e-6);
  EXPECT_NEAR(e.chains[0].greatest / T, 1.0, 1e-6);
  const Mesh bars = ties_mesh(e);
  EXPECT_EQ(bars.num_cells(), 16);
  for (const double force : bars.array<double>(bars.cell_data, "force_N", 1))
    EXPECT_NEAR(force / T, 1.0, 1e-6);
}

// A dome whose head joints are aligned has no hoop tension but that of its chain. Without friction at the
// base the chain holds the thrust alone, and the forces across a vertical plane through the axis cancel.
TEST(Chain, HoldsADomeWithoutFrictionAtItsBase) {
  const ProgramFolder folder;
  Case scene = hemisphere(70.0, 10);
  scene.postproc.planes = {CutPlane{"half", Vec3::Zero(), Vec3(1.0, 0.0, 0.0)}};
  scene.postproc.meridians = {Meridian{"x", 0.0}};
  const Evaluation e = solve_and_evaluate(scene, folder);
  ASSERT_EQ(e.summary.status, Status::stable) << e.summary.message;
  ASSERT_EQ(e.chains.size(), 1u);
  EXPECT_GT(e.chains[0].least, 0.0);
  ASSERT_EQ(e.planes.size(), 1u);
  EXPECT_LT(e.planes[0].from_ties.x(), 0.0);  // towards the other half
  EXPECT_NEAR(-e.planes[0].from_ties.x() / (2.0 * e.chains[0].mean), 1.0, 1e-6);
  EXPECT_LT(e.planes[0].relative_difference, 1e-6);
  double sum = 0.0, chain = 0.0;  // of the rings across half the plane
  for (const HoopRow& row : e.meridians.at(0).hoop) {
    sum += row.sum();
    chain += row.tie_force;
  }
  EXPECT_NEAR(chain / -e.chains[0].mean, 1.0, 1e-6);
  EXPECT_NEAR(sum / e.chains[0].mean, 0.0, 1e-5);
  // A motion drops the joints of a course that is cracked through, of which the chain is left.
  JointWrenches none = e.last.joints;
  none.wrenches.clear();
  const std::vector<HoopRow> alone = hoop_forces(e.assembly, none, 0.0, e.last.frame.ties);
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_NEAR(alone[0].tie_force / chain, 1.0, 1e-12);     // rounding
  EXPECT_NEAR(alone[0].height, e.chains[0].height, 2e-3);  // as built: the dome has settled

  scene.geometry.chains.clear();
  const Assembly loose = generate(scene);
  const Summary without =
      run_static(scene, loose, {[](const Frame&) {}, [](const std::string&) {}, [](const std::string&) {}});
  EXPECT_EQ(without.status, Status::moving) << without.message;
}

// Three bars of which two cross the plane through the axis, one of them far from its ends: each half of the
// plane has its own, and both together what the plane has.
TEST(Chain, OfFewBarsCrossesTheHalfPlaneInWhichItsBarsMeetIt) {
  const ProgramFolder folder;
  Case scene = hemisphere(70.0, 6);
  scene.joints.base.reset();
  scene.geometry.chains[0].links = 3;
  scene.geometry.chains[0].prestress = 8000.0;
  const double angle = 20.0 * pi / 180.0;
  scene.postproc.planes = {CutPlane{"whole", Vec3::Zero(), Vec3(-std::sin(angle), std::cos(angle), 0.0)}};
  scene.postproc.meridians = {Meridian{"near", 20.0}, Meridian{"far", 200.0}};
  const Evaluation e = solve_and_evaluate(scene, folder);
  ASSERT_EQ(e.meridians.size(), 2u);
  double sum = 0.0;
  for (const MeridianEvaluation& meridian : e.meridians) {
    double ties = 0.0;
    for (const HoopRow& row : meridian.hoop) ties += row.tie_force;
    EXPECT_LT(ties, -0.5 * 8000.0) << meridian.thrust.name;
    sum += ties;
  }
  ASSERT_EQ(e.planes.size(), 1u);
  EXPECT_NEAR(std::abs(sum), std::abs(e.planes[0].from_ties.dot(scene.postproc.planes[0].normal)),
              1e-9 * std::abs(sum))
      << "rounding";
}

}  // namespace
}  // namespace cupola::chains_test
