#include "postproc/mechanics/block_fields.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/base/error.hpp"
#include "postproc/mechanics/chain_forces.hpp"

namespace cupola {
namespace {

/// Of every block as built, back to which its forces turn with it.
std::vector<Mat3> mean_stresses(const Assembly& assembly, const Frame& frame,
                                const std::vector<PointForce>& loads, const Poses& poses) {
  CUPOLA_ASSERT(frame.blocks.position.size() == assembly.blocks.size());
  std::vector<Mat3> stress(assembly.blocks.size(), Mat3::Zero());
  const auto add = [&](int block, const Vec3& at, const Vec3& force) {
    const Wrench built = poses.as_built(block, Wrench{at, force, Vec3::Zero()});
    stress[block] += (built.point - assembly.blocks[block].centroid) * built.force.transpose();
  };
  const ContactTable& c = frame.contacts;
  for (int i = 0; i < c.size(); ++i) {
    add(c.block_b[i], c.point[i], c.force[i]);
    add(c.block_a[i], c.point[i], -c.force[i]);
  }
  const TieTable& ties = frame.ties;
  for (int i = 0; i < ties.size(); ++i) {
    const Vec3 on_b = tie_force_on_b(ties, i);
    add(ties.block_b[i], ties.point_b[i], on_b);
    add(ties.block_a[i], ties.point_a[i], -on_b);
  }
  for (const PointForce& load : loads) add(load.block, poses.placed(load.block, load.point), load.force);
  for (size_t b = 0; b < stress.size(); ++b) stress[b] /= assembly.blocks[b].volume;
  return stress;
}

/// The vertices of every block.
std::vector<std::vector<int>> vertices_of_blocks(const Assembly& assembly) {
  std::vector<std::vector<int>> vertices(assembly.blocks.size());
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      vertices[part.block].insert(vertices[part.block].end(), assembly.face(f).begin(),
                                  assembly.face(f).end());
  for (std::vector<int>& of_block : vertices) {
    std::ranges::sort(of_block);
    of_block.erase(std::unique(of_block.begin(), of_block.end()), of_block.end());
  }
  return vertices;
}

}  // namespace

std::vector<BlockFields> block_fields(const Assembly& assembly, const Frame& frame,
                                      const JointWrenches& joints, const std::vector<Wrench>& from_below,
                                      const std::vector<PointForce>& loads,
                                      const std::vector<ShellAxes>& axes, const Poses& poses) {
  CUPOLA_ASSERT(from_below.size() == assembly.blocks.size() && axes.size() == assembly.blocks.size());
  std::vector<BlockFields> fields(assembly.blocks.size());
  const std::vector<Mat3> stress = mean_stresses(assembly, frame, loads, poses);
  const Floor& floor = joints.floor;
  const double size = block_size(assembly), per_metre = size > 0.0 ? floor.force / size : 0.0;
  for (size_t b = 0; b < fields.size(); ++b) {
    fields[b].resultant = above(from_below[b].force.norm(), floor.force);
    fields[b].couple_length = couple_length(from_below[b], floor);
    if (!axes[b].exists || assembly.blocks[b].fixed) continue;
    const auto along = [&](const Vec3& axis) { return -axis.dot(stress[b] * axis) * axes[b].thickness; };
    double meridional = along(axes[b].m), hoop = along(axes[b].t);
    if (axes[b].pole) meridional = hoop = 0.5 * (meridional + hoop);
    fields[b].meridional_force = above(meridional, per_metre);
    fields[b].hoop_force = above(hoop, per_metre);
  }
  for (const JointWrench& joint : joints.wrenches) {
    for (const int b : {joint.block_a, joint.block_b}) {
      fields[b].friction_use = std::fmax(fields[b].friction_use, joint.friction_use);  // skips NaN
      if (joint.upper >= 0) fields[b].kern = std::fmax(fields[b].kern, joint.kern);
      fields[b].opening = std::max(fields[b].opening, joint.opening);
      fields[b].slip = std::max(fields[b].slip, joint.slip);
    }
  }
  return fields;
}

std::vector<int> mechanism_groups(const Assembly& assembly, const std::vector<Eigen::Isometry3d>& poses,
                                  const JointWrenches& joints, double threshold) {
  const size_t num_blocks = assembly.blocks.size();
  DisjointSets together(num_blocks);
  int first_fixed = -1;
  for (size_t b = 0; b < num_blocks; ++b) {
    if (!assembly.blocks[b].fixed) continue;
    if (first_fixed >= 0) together.join(first_fixed, static_cast<int>(b));
    first_fixed = first_fixed < 0 ? static_cast<int>(b) : first_fixed;
  }
  const std::vector<std::vector<int>> vertices = vertices_of_blocks(assembly);
  /// How far a vertex of `block` is from where the other block would carry it.
  const auto apart = [&](int block, int other) {
    double farthest = 0.0;
    for (const int v : vertices[block])
      farthest = std::max(farthest,
                          (poses[block] * assembly.vertices[v] - poses[other] * assembly.vertices[v]).norm());
    return farthest;
  };
  for (const JointWrench& joint : joints.wrenches) {
    const int a = joint.block_a, b = joint.block_b;
    if (std::min(apart(a, b), apart(b, a)) <= threshold) together.join(a, b);
  }
  // Number the groups: the supports first, then in the order of first blocks.
  std::vector<int> number(num_blocks, -1), group(num_blocks);
  int count = 0;
  if (first_fixed >= 0) number[together.root(first_fixed)] = count++;
  for (size_t b = 0; b < num_blocks; ++b) {
    int& n = number[together.root(static_cast<int>(b))];
    if (n < 0) n = count++;
    group[b] = n;
  }
  return group;
}

}  // namespace cupola
