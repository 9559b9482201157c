// Imperfections of domes whose beds are cones from the springing on: the blocks and the support have the
// facets of one cone, wherever their corners have moved.

#include <gtest/gtest.h>

#include "assembly/model/polygon_parts.hpp"
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

/// m2, of the faces of the first course that lie on supports.
double bearing_area(const Case& c) {
  const Assembly assembly = generate(c);
  std::vector<PlanePolygon> supports;
  double area = 0.0;
  for (size_t b = 0; b < assembly.blocks.size() && assembly.blocks[b].ring <= 0; ++b)
    for (const PlanePolygon& face : faces_of_block(assembly, static_cast<int>(b))) {
      if (assembly.blocks[b].fixed) {
        supports.push_back(face);
        continue;
      }
      area += polygon_area(face.corners);
      for (const auto& piece : uncovered(face, supports, 1e-10)) area -= polygon_area(piece);  // m, rounding
    }
  return area;
}

// Between the cuts of the dome the sides of base blocks lay on the cone instead of the facet under the stones:
// inside the stones of the horseshoe, and up to 19 % of the first bed of the segment had no support.
TEST(InclinedSpringing, LiesOnAllBlocksOfADividedBase) {
  for (const Profile::Kind profile : {Profile::Kind::segmental, Profile::Kind::horseshoe}) {
    Case c = dome(profile, RunningBond{10, 16, 2}, 0.0, 0.0, 1);
    std::get<VaultSurface>(c.geometry.surface).profile.below_deg = 20.0;
    for (const bool oval : {false, true}) {
      if (oval) c.geometry.affine = Affine{{1.5, 1.0, 0.8}, 0.0, 0.0};
      c.geometry.base_blocks = 1;
      const double whole = bearing_area(c);
      for (const int number : {2, 5, 7}) {
        c.geometry.base_blocks = number;
        EXPECT_NEAR(bearing_area(c) / whole, 1.0, 1e-9) << number << " blocks; slivers at their sides";
      }
    }
  }
}

}  // namespace
}  // namespace cupola::inclined_springing_test
