#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/content_hash.hpp"
#include "generators/generate.hpp"
#include "tests/generators/models.hpp"

namespace cupola::imperfections_test {
namespace {

std::vector<Surface> all_surfaces() {
  OctagonalVault planar;
  planar.construction = OctagonalVault::Construction::planar_radial;
  return {DomeSurface{}, OctagonalVault{}, planar, WallSurface{12.0, 10.0, 1.0}};
}

Case imperfect(const Surface& surface, double gap, double noise, int seed) {
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = RunningBond{10, 16, 4, {}};
  if (gap > 0.0 || noise > 0.0) c.geometry.imperfections = Imperfections{gap, noise, seed};
  return c;
}

// generate() checks that every face is plane within 1e-13 of the model's size.
TEST(Imperfections, OfNoiseKeepFacesPlaneAndJointsClosed) {
  for (const Surface& surface : all_surfaces()) {
    ModelReport perfect, noisy;
    const Assembly a = check_and_report(imperfect(surface, 0.0, 0.0, 1), &perfect);
    const Assembly b = check_and_report(imperfect(surface, 0.0, 2e-3, 1), &noisy);
    EXPECT_EQ(noisy.num_joints, perfect.num_joints);
    EXPECT_EQ(noisy.islands, 1);
    EXPECT_NE(noisy.volume, perfect.volume);
    EXPECT_NEAR(noisy.volume, perfect.volume, 5e-3 * perfect.volume);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    double furthest = 0.0;
    for (size_t v = 0; v < a.vertices.size(); ++v)
      furthest = std::max(furthest, (a.vertices[v] - b.vertices[v]).norm());
    EXPECT_GT(furthest, 1e-3);
    EXPECT_LT(furthest, 3 * 2e-3);  // three shifts of up to 2 mm, scaled by 38.2 / 36 on the extrados
  }
}

// With gaps of up to g no block touches another. Each bed and head recedes by at most g/2, which bounds the
// loss of volume.
TEST(Imperfections, OfGapsOpenEveryJoint) {
  for (const Surface& surface : all_surfaces()) {
    ModelReport perfect, open;
    check_and_report(imperfect(surface, 0.0, 0.0, 1), &perfect);
    check_and_report(imperfect(surface, 1e-3, 0.0, 7), &open);
    EXPECT_EQ(open.num_joints, perfect.num_joints) << "open joints count as the solver counts them";
    EXPECT_LT(open.max_overlap, 0.0);
    EXPECT_LT(open.volume, perfect.volume);
    // Courses are at least 0.9 m high, blocks at least 0.7 m wide.
    EXPECT_GT(open.volume, perfect.volume * (1.0 - 1e-3 * (1.0 / 0.9 + 1.0 / 0.7)));
  }
}

TEST(Imperfections, DependOnTheSeedOnly) {
  const auto hash = [](int seed) {
    return content_hash(cut_assembly(imperfect(DomeSurface{}, 1e-3, 1e-3, seed)));
  };
  EXPECT_EQ(hash(3), hash(3));
  EXPECT_NE(hash(3), hash(4));
}

TEST(Imperfections, ThatAreTooLargeAreRejected) {
  EXPECT_THROW(generate(imperfect(WallSurface{1.0, 0.5, 0.1}, 0.0, 0.5, 1)), InputError);
}

}  // namespace
}  // namespace cupola::imperfections_test
