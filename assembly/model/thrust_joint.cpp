#include "assembly/model/thrust_joint.hpp"

#include <algorithm>
#include <utility>

namespace cupola {

int bearer_of_thrust(const Assembly& assembly, const Sheet& sheet, const Joint& joint, const Vec3& centroid) {
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
  return stands && joint.kind != JointKind::head ? lower : -1;
}

}  // namespace cupola
