#include "solver/dynamics/heat.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/block_region.hpp"
#include "assembly/model/loaded_faces.hpp"

namespace cupola {
namespace {

/// Mean outward normal of the extrados of each block; zero without extrados (num_blocks).
std::vector<Vec3> extrados_normals(const Assembly& assembly) {
  std::vector<Vec3> normals(assembly.blocks.size(), Vec3::Zero());
  for (const LoadedFace& face : faces_of_kind(assembly, std::array{FaceKind::extrados}, 0, kLastRing, ""))
    normals[face.block] += face.area * face.normal;
  for (Vec3& normal : normals) normal = normal.stableNormalized();
  return normals;
}

Vec3 mean_centroid(const Assembly& assembly, const std::vector<RegionBlock>& blocks) {
  Vec3 sum = Vec3::Zero();
  for (const RegionBlock& b : blocks) sum += assembly.blocks[b.block].centroid;
  return sum / static_cast<double>(blocks.size());
}

}  // namespace

HeatedBlocks::HeatedBlocks(const Case& scene, const Assembly& assembly) {
  if (scene.loads.heat.empty()) return;
  of_block_.resize(assembly.blocks.size());
  std::vector<Vec3> normals;
  for (size_t i = 0; i < scene.loads.heat.size(); ++i) {
    const BlockHeat& heat = scene.loads.heat[i];
    const std::string key = fmt::format("loads.heat[{}]", i);
    if (heat.through != 0.0 && normals.empty()) normals = extrados_normals(assembly);
    for (const RegionBlock& b : blocks_of_region(heat.region, assembly, false, key)) {
      Vec3 growth = heat.gradient;
      if (heat.through != 0.0) {
        if (normals[b.block].isZero(0.0))
          throw InputError(
              fmt::format("{}.through: block {} has no extrados; give gradient, or leave the block out", key,
                          block_label(assembly, b.block)));
        growth += heat.through * normals[b.block];
      }
      const double alpha = b.factor * heat.expansion;
      add(b.block, {Vec3::Zero(), alpha * heat.change, alpha * growth, heat.time});
    }
    if (!heat.ground) continue;
    const std::vector<RegionBlock> ground = blocks_of_region({}, assembly, true, key);
    const Vec3 middle = mean_centroid(assembly, ground);
    for (const RegionBlock& b : ground)
      add(b.block, {middle - assembly.blocks[b.block].centroid, heat.expansion * heat.change, Vec3::Zero(),
                    heat.time});
  }
}

Vec3 HeatedBlocks::displacement(int block, const Pose& pose, const Vec3& point, double time) const {
  const Vec3 from_centroid = pose.q_WB.conjugate() * (point - pose.p_WB);
  Vec3 sum = Vec3::Zero();
  for (const BlockExpansion& e : of_block_[block]) {
    const Vec3 x = from_centroid - e.centre;
    sum +=
        factor_at(e.time, time) * ((e.strain + e.gradient.dot(x)) * x - 0.5 * x.squaredNorm() * e.gradient);
  }
  return pose.q_WB * sum;
}

Vec3 HeatedBlocks::separation(const std::vector<Pose>& poses, const Contact& contact, double time) const {
  const Vec3 b = displacement(contact.block_b, poses[contact.block_b], contact.point_b, time);
  if (contact.block_a < 0) return b;
  return b - displacement(contact.block_a, poses[contact.block_a], contact.point_a, time);
}

ContactSet HeatedBlocks::heated(ContactSet contacts, const std::vector<Pose>& poses, double time) const {
  for (Contact& contact : contacts.points)
    contact.gap += contact.normal.dot(separation_before(poses, contact, time));
  return contacts;
}

bool HeatedBlocks::stays_in_plane() const {
  return std::ranges::all_of(of_block_, [](const std::vector<BlockExpansion>& of_one) {
    return std::ranges::all_of(of_one, [](const BlockExpansion& e) { return e.gradient.y() == 0.0; });
  });
}

}  // namespace cupola
