#include "assembly/model/thrust_joint.hpp"

#include <algorithm>
#include <utility>

namespace cupola {

namespace {

/// True if `upper` stands or leans on `lower` by a joint with this normal of either sign. By a level normal it
/// does so unless heads meet.
bool bears(const Assembly& assembly, int lower, int upper, JointKind kind, const Vec3& normal) {
  constexpr double kLevel = 1e-6;
  const bool upwards = normal.dot(assembly.blocks[upper].centroid - assembly.blocks[lower].centroid) >= 0.0;
  const double rise = upwards ? normal.z() : -normal.z();
  return rise > kLevel || (rise >= -kLevel && kind != JointKind::head);
}

}  // namespace

int bearer_of_thrust(const Assembly& assembly, const Sheet& sheet, const Joint& joint, const Vec3& centroid,
                     const Vec3& normal) {
  const auto [first, end] = assembly.stack_of(sheet.first_ring);
  const auto course = [&assembly](int block) {
    return assembly.blocks[block].fixed ? -1 : std::max(assembly.blocks[block].ring, 0);
  };
  const auto [lower, upper] = course(joint.block_a) < course(joint.block_b)
                                  ? std::pair(joint.block_a, joint.block_b)
                                  : std::pair(joint.block_b, joint.block_a);
  if (course(upper) < first || course(upper) >= std::max(end, 1) || course(lower) >= first) return -1;
  if (assembly.blocks[lower].fixed) return lower;
  const bool far_side = sheet.thrust_lines == Sheet::ThrustLines::one && sheet.own(centroid).x() < 0.0;
  const Block& block = assembly.blocks[upper];
  const bool stands = far_side ? block.ring + block.num_rings == end : block.ring == first;
  return stands && bears(assembly, lower, upper, joint.kind, normal) ? lower : -1;
}

}  // namespace cupola
