#include <algorithm>
#include <map>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"

namespace cupola::invariance_test {
namespace {

/// A small dome with a lantern: all kinds of joints, forces in all directions.
Case small_dome() {
  Case scene;
  RunningBond bond;
  bond.rings = 8;
  bond.blocks_per_ring = 12;
  bond.slices_per_block = 2;
  scene.geometry.bond = bond;
  scene.loads.lantern = TopLoad{0.02};
  scene.analysis.tolerance = 1e-10;
  return scene;
}

using Pair = std::pair<int, int>;

/// Force of block a on block b, summed over their contacts, N.
std::map<Pair, Vec3> joint_forces(const Case& scene, const Assembly& assembly) {
  Frame last;
  const Summary summary = run_static(
      scene, assembly,
      {[&last](const Frame& frame) { last = frame; }, [](const std::string&) {}, [](const std::string&) {}});
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  std::map<Pair, Vec3> forces;
  for (int i = 0; i < last.contacts.size(); ++i) {
    const Pair pair{last.contacts.block_a[i], last.contacts.block_b[i]};
    forces.try_emplace(pair, Vec3::Zero()).first->second += last.contacts.force[i];
  }
  return forces;
}

/// Largest difference between `image` and the transformed `original`, over the total weight.
template <class BlockMap>
double worst_difference(const std::map<Pair, Vec3>& original, const std::map<Pair, Vec3>& image,
                        const Mat3& rotation, const BlockMap& new_block, double scale) {
  EXPECT_EQ(original.size(), image.size());
  double worst = 0.0;
  for (const auto& [pair, force] : original) {
    const int a = new_block(pair.first), b = new_block(pair.second);
    const auto found = image.find({std::min(a, b), std::max(a, b)});
    if (found == image.end()) return 1e300;
    const Vec3 expected = (a < b ? 1.0 : -1.0) * (rotation * force);
    worst = std::max(worst, (found->second - expected).norm() / scale);
  }
  return worst;
}

int same_block(int block) {
  return block;
}

// Ten times the tolerance of each solve, per ring of the dome.
constexpr double kTolerance = 1e-8;

class Invariance : public ::testing::Test {
 protected:
  Case scene_ = small_dome();
  Assembly assembly_ = generate(scene_);
  std::map<Pair, Vec3> forces_ = joint_forces(scene_, assembly_);
  double weight_ = free_weight(assembly_, 9.81);
};

TEST_F(Invariance, UnderRotationOfTheWorld) {
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (Vec3& vertex : assembly_.vertices) vertex = R * vertex;
  compute_mass_properties(&assembly_);
  scene_.loads.gravity = R * scene_.loads.gravity;
  EXPECT_LT(worst_difference(forces_, joint_forces(scene_, assembly_), R, same_block, weight_), kTolerance);
}

TEST_F(Invariance, UnderReflection) {
  const Mat3 mirror = Vec3(1, -1, 1).asDiagonal();
  for (Vec3& vertex : assembly_.vertices) vertex = mirror * vertex;
  for (int f = 0; f < assembly_.num_faces(); ++f)  // a reflection reverses the orientation of faces
    std::reverse(assembly_.face_vertices.begin() + assembly_.face_vertex_start[f],
                 assembly_.face_vertices.begin() + assembly_.face_vertex_start[f + 1]);
  compute_mass_properties(&assembly_);
  EXPECT_LT(worst_difference(forces_, joint_forces(scene_, assembly_), mirror, same_block, weight_),
            kTolerance);
}

TEST_F(Invariance, UnderTranslationFarFromTheOrigin) {
  const Vec3 far(3e4, -2e4, 1e4);  // site coordinates; rounding is 1e-11 m
  for (Vec3& vertex : assembly_.vertices) vertex += far;
  compute_mass_properties(&assembly_);
  // Rounding of the vertices to eps * 4e4 m = 7e-12 m causes gaps of 1e-9 times the elastic penetration of
  // 1e-2 m.
  EXPECT_LT(worst_difference(forces_, joint_forces(scene_, assembly_), Mat3::Identity(), same_block, weight_),
            1e-7);
}

TEST_F(Invariance, UnderPermutationOfTheBlocks) {
  const int n = static_cast<int>(assembly_.blocks.size());
  const auto permuted = [n](int block) { return (block * 7 + 3) % n; };
  ASSERT_NE(n % 7, 0);
  Assembly shuffled = assembly_;
  for (int block = 0; block < n; ++block) shuffled.blocks[permuted(block)] = assembly_.blocks[block];
  for (Part& part : shuffled.parts) part.block = permuted(part.block);
  std::stable_sort(shuffled.parts.begin(), shuffled.parts.end(),
                   [](const Part& a, const Part& b) { return a.block < b.block; });
  EXPECT_LT(worst_difference(forces_, joint_forces(scene_, shuffled), Mat3::Identity(), permuted, weight_),
            kTolerance);
}

// Lengths times 1000 give weights times 1e9; with zero gaps the resultants are proportional to the weight.
TEST_F(Invariance, UnderScalingOfLengths) {
  for (Vec3& vertex : assembly_.vertices) vertex *= 1000.0;
  compute_mass_properties(&assembly_);
  std::map<Pair, Vec3> scaled = joint_forces(scene_, assembly_);
  for (auto& [pair, force] : scaled) force /= 1e9;
  EXPECT_LT(worst_difference(forces_, scaled, Mat3::Identity(), same_block, weight_), kTolerance);
}

// With zero gaps, static forces depend only on ratios of compliances.
TEST_F(Invariance, UnderScalingOfAllCompliances) {
  for (const double c : {2e-8, 2e-10, 1e-12}) {
    scene_.joints.compliance = {c, c, Compliance::Per::point};
    EXPECT_LT(
        worst_difference(forces_, joint_forces(scene_, assembly_), Mat3::Identity(), same_block, weight_),
        kTolerance)
        << "c = " << c;
  }
}

}  // namespace
}  // namespace cupola::invariance_test
