#include <cmath>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/model/random_field.hpp"
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

// Over a correlation length far above the model every number is that of the origin, whatever the bond. The
// narrowest joints are those with the support, which does not recede: half of the number.
TEST(Imperfections, OfACorrelationLengthAreTheSameFunctionForEveryBond) {
  const double length = 1e9, gap = 1e-3;
  const double expected = 0.5 * gap * RandomField(3, "gap", length, 1.0).quantile_at(Vec3::Zero());
  for (const int per_ring : {8, 16}) {
    Case c = imperfect(WallSurface{12.0, 10.0, 1.0}, gap, 0.0, 3);
    c.geometry.bond = RunningBond{10, per_ring, 4, {}};
    c.geometry.imperfections->correlation_length = length;
    ModelReport report;
    check_and_report(c, &report);
    EXPECT_NEAR(report.max_overlap, -expected, 1e-6 * gap) << "12 m over 1e9 m, times a slope of at most 80";
  }
}

TEST(Imperfections, OfAShortCorrelationLengthDifferFromPlaceToPlace) {
  Case c = imperfect(DomeSurface{}, 1e-3, 1e-3, 3);
  const std::string independent = content_hash(cut_assembly(c));
  c.geometry.imperfections->correlation_length = 2.0;
  const std::string correlated = content_hash(cut_assembly(c));
  EXPECT_NE(correlated, independent);
  EXPECT_EQ(correlated, content_hash(cut_assembly(c)));
  c.geometry.imperfections->correlation_length = 4.0;
  EXPECT_NE(content_hash(cut_assembly(c)), correlated);
}

// Free blocks have the density of the field at their place, supports that of the case; what is finer than a
// block averages out over it.
TEST(Imperfections, OfTheDensityFollowTheField) {
  Case c = imperfect(DomeSurface{}, 0.0, 0.0, 1);
  const Assembly plain = cut_assembly(c);
  c.geometry.imperfections = Imperfections{.seed = 5, .correlation_length = 1e9, .density = 0.2};
  const Assembly uniform = cut_assembly(c);
  const double factor = RandomField(5, "density", 1e9, 0.2).at(Vec3::Zero());
  for (size_t b = 0; b < plain.blocks.size(); ++b) {
    const double expected = plain.blocks[b].fixed ? 1.0 : factor;
    EXPECT_NEAR(uniform.blocks[b].density / plain.blocks[b].density, expected, 1e-6);
    EXPECT_NEAR(uniform.blocks[b].mass / plain.blocks[b].mass, expected, 1e-6);
    EXPECT_TRUE(uniform.blocks[b].inertia.isApprox(expected * plain.blocks[b].inertia, 1e-6));
  }
  const auto deviation = [&](double length) {
    c.geometry.imperfections->correlation_length = length;
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (const Block& block : cut_assembly(c).blocks) {
      if (block.fixed) continue;
      const double x = block.density / c.material.density();
      sum += x, squares += x * x, ++count;
    }
    return std::sqrt(squares / count - sum * sum / count / count);
  };
  EXPECT_GT(deviation(5.0), 0.1) << "0.2 at one place; a dome of 36 m has some 20 independent ones";
  EXPECT_LT(deviation(0.5), 0.1) << "a block of 7 x 2 x 2 m averages over some 100 independent places";
}

TEST(Imperfections, ThatAreTooLargeAreRejected) {
  EXPECT_THROW(generate(imperfect(WallSurface{1.0, 0.5, 0.1}, 0.0, 0.5, 1)), InputError);
}

}  // namespace
}  // namespace cupola::imperfections_test
