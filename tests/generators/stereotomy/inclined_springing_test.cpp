// Imperfections of domes whose beds are cones from the springing on: the blocks and the support have the
// facets of one cone, wherever their corners have moved.

#include <gtest/gtest.h>

#include "tests/generators/models.hpp"

namespace cupola::inclined_springing_test {
namespace {

/// Of 6 m span, 2 m high, of 10 courses of 16 blocks.
Case dome(Profile::Kind profile, const Bond& bond, double gap, double noise, int seed) {
  Case c;
  VaultSurface surface;
  surface.plan.kind = Plan::Kind::circle;
  surface.profile.kind = profile;
  surface.profile.span = 6.0;
  surface.profile.rise = 2.0;
  surface.thickness = 0.3;
  surface.eye = 0.4;
  c.geometry.surface = surface;
  c.geometry.bond = bond;
  if (gap > 0.0 || noise > 0.0) c.geometry.imperfections = Imperfections{gap, noise, seed};
  return c;
}

ModelReport report_of(const Case& c) {
  ModelReport report;
  check_and_report(c, &report);
  return report;
}

const std::vector<Bond>& bonds() {
  static const std::vector<Bond> kBonds{RunningBond{10, 16, 2}, StackBond{10, 16, 2}};
  return kBonds;
}

TEST(InclinedSpringing, NoiseKeepsJointsClosed) {
  for (const Profile::Kind profile : {Profile::Kind::segmental, Profile::Kind::catenary})
    for (const Bond& bond : bonds()) {
      const int joints = report_of(dome(profile, bond, 0.0, 0.0, 0)).num_joints;
      for (const double noise : {1e-5, 2e-3})
        for (int seed = 1; seed <= 2; ++seed) {
          const ModelReport noisy = report_of(dome(profile, bond, 0.0, noise, seed));
          EXPECT_EQ(noisy.num_joints, joints) << noise << " m, seed " << seed;
          EXPECT_EQ(noisy.islands, 1);
        }
    }
}

TEST(InclinedSpringing, GapsOpenEveryJoint) {
  for (const Bond& bond : bonds()) {
    const int joints = report_of(dome(Profile::Kind::segmental, bond, 0.0, 0.0, 0)).num_joints;
    for (const auto& [gap, noise] : {std::pair{2e-4, 0.0}, {1e-6, 0.0}, {2e-4, 1e-3}})
      for (int seed = 1; seed <= 4; ++seed) {
        const ModelReport open = report_of(dome(Profile::Kind::segmental, bond, gap, noise, seed));
        EXPECT_LT(open.max_overlap, 0.0) << gap << " m, seed " << seed;
        EXPECT_EQ(open.num_joints, joints) << gap << " m, seed " << seed;
      }
  }
}

}  // namespace
}  // namespace cupola::inclined_springing_test
