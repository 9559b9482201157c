#include <algorithm>
#include <map>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "generators/importer/import.hpp"
#include "solver/collision/contact_detector.hpp"
#include "tests/generators/shared_data.hpp"

// Contact detection against brute force: each face of each block against all others, without bounding boxes,
// trees, separating axes or merging of patches.

namespace cupola::contact_area_test {
namespace {

using BlockPair = std::pair<int, int>;
using Polygon = std::vector<Vec3>;

/// Area of the intersection of the convex polygons p and q, which lie in the plane with this normal: p is
/// clipped at each edge of q.
double overlap_area(Polygon p, const Polygon& q, const Vec3& normal) {
  for (std::size_t k = 0; k < q.size() && !p.empty(); ++k) {
    const Vec3 inward = normal.cross(q[(k + 1) % q.size()] - q[k]);
    Polygon inside;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 &x = p[i], &next = p[(i + 1) % p.size()];
      const double here = inward.dot(x - q[k]), there = inward.dot(next - q[k]);
      if (here >= 0.0) inside.push_back(x);
      if ((here < 0.0) != (there < 0.0)) inside.push_back(x + here / (here - there) * (next - x));
    }
    p = inside;
  }
  return p.size() < 3 ? 0.0 : polygon_area(p);
}

/// Overlap of opposed coplanar faces per pair of blocks, m2.
std::map<BlockPair, double> brute_force(const Assembly& assembly, double distance) {
  struct Face {
    int block;
    Polygon corners;
    Plane plane;
  };
  std::vector<Face> faces;
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] == FaceKind::internal) continue;
      const Polygon corners = face_points(assembly, f);
      faces.push_back({part.block, corners, polygon_plane(corners)});
    }
  std::map<BlockPair, double> areas;
  for (const Face& a : faces)
    for (const Face& b : faces) {
      if (a.block >= b.block || (assembly.blocks[a.block].fixed && assembly.blocks[b.block].fixed)) continue;
      if (a.plane.normal.dot(b.plane.normal) > -1.0 + 1e-9) continue;
      const auto off_a = [&](const Vec3& x) {
        return std::abs(a.plane.normal.dot(x) - a.plane.offset) > distance;
      };
      if (std::ranges::any_of(b.corners, off_a)) continue;
      const Polygon opposite(b.corners.rbegin(), b.corners.rend());
      const double area = overlap_area(a.corners, opposite, a.plane.normal);
      if (area > 0.0) areas[{a.block, b.block}] += area;
    }
  return areas;
}

/// Checks the contact area of every pair of blocks against brute force, to `accuracy` of the largest area.
/// Overlaps below `smallest` (m2) are slivers and form no joint.
void expect_same_areas(const Assembly& assembly, double smallest, double distance, double accuracy = 1e-9) {
  std::map<BlockPair, double> found;
  const ContactSet set = ContactDetector(assembly, {}).update(initial_poses(assembly));
  for (const Patch& patch : set.patches) found[{patch.block_a, patch.block_b}] += patch.area;
  const std::map<BlockPair, double> expected = brute_force(assembly, distance);
  double largest = 0.0;
  for (const auto& [pair, area] : expected) largest = std::max(largest, area);
  int joints = 0;
  for (const auto& [pair, area] : expected) {
    if (area < smallest) continue;
    ++joints;
    EXPECT_NEAR(found[pair], area, accuracy * largest) << "blocks " << pair.first << " and " << pair.second;
  }
  EXPECT_GT(joints, 0);
  for (const auto& [pair, area] : found) {
    EXPECT_GT(expected.contains(pair) ? expected.at(pair) : 0.0, 0.0)
        << "blocks " << pair.first << " and " << pair.second << " touch with " << area << " m2";
  }
}

TEST(ContactArea, AgreesWithBruteForceOnSmallWalls) {
  for (const auto& [blocks, rings] : {std::pair{3, 4}, {7, 5}, {10, 9}}) {
    Case scene;
    scene.geometry.surface = WallSurface{4.0, 2.0, 0.5};
    scene.geometry.bond = RunningBond{.rings = rings, .blocks_per_ring = blocks, .slices_per_block = 2};
    expect_same_areas(cut_assembly(scene), 1e-9, 1e-9);
  }
}

TEST(ContactArea, AgreesWithBruteForceOnSmallDomes) {
  for (const auto& [blocks, rings] : {std::pair{8, 6}, {13, 5}}) {
    Case scene;
    scene.geometry.bond = RunningBond{.rings = rings, .blocks_per_ring = blocks, .slices_per_block = 4};
    expect_same_areas(cut_assembly(scene), 1e-9, 1e-9);
  }
}

// Models from other programs, whose faces coincide to a micrometre or better.
TEST(ContactArea, AgreesWithBruteForceOnImportedModels) {
  // Facing faces lie in planes that differ by the rounding of the files, 1e-8 of the block size and less. The
  // detector measures in the plane between them, brute force in one of them.
  constexpr double kRounding = 1e-7;
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  for (const char* file :
       {"A", "H", "bridge", "cubes", "shelf-stable", "snake", "type-a", "type-b", "type-c", "type-d"}) {
    SCOPED_TRACE(file);
    ImportedBlocks source;
    source.path = shared_data() + "/compas_cra/" + file + ".json";
    expect_same_areas(import_blocks(source, 1000.0), 1e-6, 1e-6, kRounding);
  }
}

}  // namespace
}  // namespace cupola::contact_area_test
