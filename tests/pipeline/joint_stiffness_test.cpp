#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"

namespace cupola::joint_stiffness_test {
namespace {

using BlockPair = std::pair<int, int>;
using Wrench = Eigen::Matrix<double, 6, 1>;  ///< force (N) and moment about the origin (N m) on block b

/// Joint wrenches of the static solution.
std::map<BlockPair, Wrench> joint_wrenches(const Case& scene) {
  Frame frame;
  AnalysisSinks sinks;
  sinks.frame = [&frame](const Frame& f) { frame = f; };
  const Summary summary = run_static(scene, cut_assembly(scene), sinks);
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  std::map<BlockPair, Wrench> wrenches;
  const ContactTable& contacts = frame.contacts;
  for (int i = 0; i < contacts.size(); ++i) {
    Wrench wrench;
    wrench << contacts.force[i], contacts.point[i].cross(contacts.force[i]);
    const auto [entry, added] =
        wrenches.emplace(BlockPair(contacts.block_a[i], contacts.block_b[i]), Wrench::Zero());
    entry->second += wrench;
  }
  return wrenches;
}

/// Largest difference between two sets of wrenches: forces over the largest force, moments over the largest
/// moment.
double difference(const std::map<BlockPair, Wrench>& p, const std::map<BlockPair, Wrench>& q) {
  EXPECT_EQ(p.size(), q.size());
  double force = 0.0, moment = 0.0, largest_force = 0.0, largest_moment = 0.0;
  for (const auto& [pair, wrench] : p) {
    if (!q.contains(pair)) return 1.0;
    const Wrench change = wrench - q.at(pair);
    force = std::max(force, change.head<3>().norm());
    moment = std::max(moment, change.tail<3>().norm());
    largest_force = std::max(largest_force, wrench.head<3>().norm());
    largest_moment = std::max(largest_moment, wrench.tail<3>().norm());
  }
  return std::max(force / largest_force, moment / largest_moment);
}

Case sliced(const Surface& surface, int rings, int blocks, int slices, Compliance::Per per) {
  Case scene;
  RunningBond bond;
  bond.rings = rings;
  bond.blocks_per_ring = blocks;
  bond.slices_per_block = slices;
  scene.geometry.surface = surface;
  scene.geometry.bond = bond;
  scene.joints.compliance = {1e-8, 1e-8, per};  // m3/N, or m/N
  return scene;
}

// A wall under inclined gravity: the number of slices per block has no influence with either kind of
// compliance, because coplanar patches are merged.
TEST(Slices, DoNotChangeTheJointsOfAWall) {
  for (const auto per : {Compliance::Per::area, Compliance::Per::point}) {
    std::vector<std::map<BlockPair, Wrench>> wrenches;
    for (const int slices : {2, 4, 8}) {
      Case scene = sliced(WallSurface{6.0, 3.0, 1.0}, 6, 5, slices, per);
      scene.loads.gravity = {0.5, 0.3, -9.81};
      wrenches.push_back(joint_wrenches(scene));
    }
    // The tolerance of the solver is 1e-9 of a block weight; differences are larger between stiff joints in
    // parallel.
    EXPECT_LT(difference(wrenches[0], wrenches[1]), 1e-6);
    EXPECT_LT(difference(wrenches[0], wrenches[2]), 1e-6);
  }
}

TEST(Slices, DoNotChangeTheJointsOfAPlanarOctagon) {
  OctagonalVault vault;
  vault.construction = OctagonalVault::Construction::planar_radial;
  const auto two = joint_wrenches(sliced(vault, 20, 16, 2, Compliance::Per::area));
  for (const int slices : {4, 8})
    EXPECT_LT(difference(two, joint_wrenches(sliced(vault, 20, 16, slices, Compliance::Per::area))), 1e-6);
}

// On conical beds the slices are chords of the circle: the geometry changes with an error of O(1 / slices^2).
TEST(Slices, ChangeConicalBedsToSecondOrder) {
  std::map<Compliance::Per, std::vector<double>> changes;
  for (const auto per : {Compliance::Per::area, Compliance::Per::point}) {
    std::vector<std::map<BlockPair, Wrench>> wrenches;
    for (const int slices : {2, 4, 8, 16})
      wrenches.push_back(joint_wrenches(sliced(DomeSurface{}, 8, 12, slices, per)));
    for (std::size_t i = 0; i + 1 < wrenches.size(); ++i)
      changes[per].push_back(difference(wrenches[i], wrenches[i + 1]));
    fmt::print("slices 2-4-8-16, compliance per {}: joint wrenches change by {:.2e}, {:.2e}, {:.2e}\n",
               per == Compliance::Per::area ? "area " : "point", changes[per][0], changes[per][1],
               changes[per][2]);
  }
  // The next term of the series is smaller than the leading one by the square of the angle of a slice: 2 pi /
  // 24 in the first pair, half of it in the second.
  const auto& area = changes[Compliance::Per::area];
  const double next = std::pow(2.0 * M_PI / 24.0, 2);
  EXPECT_NEAR(area[0] / area[1], 4.0, 4.0 * next);
  EXPECT_NEAR(area[1] / area[2], 4.0, 4.0 * next / 4.0);
}

/// Coefficient of variation of the vertical forces at the base of a symmetric dome.
double scatter_at_base(const Case& scene) {
  std::vector<double> forces;
  for (const auto& [pair, wrench] : joint_wrenches(scene))
    if (pair.first == 0 || pair.second == 0) forces.push_back(std::abs(wrench[2]));
  double mean = 0.0, square = 0.0;
  for (const double f : forces) mean += f / static_cast<double>(forces.size());
  for (const double f : forces) square += (f - mean) * (f - mean) / static_cast<double>(forces.size());
  return std::sqrt(square) / mean;
}

// The contact detection of the paper gives unequal forces on equal blocks of a symmetric dome.
TEST(PerturbedGjk, BreaksTheSymmetryThatFaceClippingKeeps) {
  Case scene = sliced(DomeSurface{}, 12, 16, 4, Compliance::Per::point);
  EXPECT_LT(scatter_at_base(scene), 1e-8);
  scene.contact.method = ContactDetection::Method::perturbed_gjk;
  for (int seed = 1; seed <= 10; ++seed) {
    scene.contact.perturbation.seed = seed;
    const double scatter = scatter_at_base(scene);
    EXPECT_GT(scatter, 1e-4) << seed;
    EXPECT_LT(scatter, 0.5) << seed;
  }
}

}  // namespace
}  // namespace cupola::joint_stiffness_test
