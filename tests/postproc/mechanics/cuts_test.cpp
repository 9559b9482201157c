#include "postproc/mechanics/cuts.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/mechanics/key_stone.hpp"

namespace cupola::cuts_test {
namespace {

// The plane through a stone passes through the key stone and two stones, and the axis through two joints: they
// count alike, whatever side rounding has them on.
// Round a ring of radial forces F at intervals of w, the force across the plane is on either side F / 2
// cot(w / 2), and between two stones F / 2 / sin(w / 2).
TEST(Hoop, DoesNotDependOnTheRoundingOfStonesAndJointsOnThePlane) {
  const double half = std::numbers::pi / test::kRound, push = -0.5 * test::kPush.x();
  for (const double rounding : {-1e-14, -3e-16, 0.0, 2e-16, 1e-14}) {  // rad
    const test::KeyStone dome(rounding);
    const JointWrenches joints =
        joint_wrenches(dome.assembly, dome.contacts, shell_of(dome.assembly, Vec3::UnitZ()));
    for (const double azimuth : {0.0, 45.0, 90.0, 180.0, -45.0, 22.5, 202.5}) {
      const std::vector<HoopRow> rows = hoop_forces(dome.assembly, joints, azimuth);
      ASSERT_EQ(rows.size(), 1u);
      EXPECT_EQ(rows[0].ring, 1);
      const bool between = azimuth == 22.5 || azimuth == 202.5;
      EXPECT_NEAR(rows[0].bed_force, between ? push / std::sin(half) : push / std::tan(half), 1e-12)
          << azimuth << " deg, " << rounding;
    }
  }
}

}  // namespace
}  // namespace cupola::cuts_test
