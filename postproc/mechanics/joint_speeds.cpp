#include "postproc/mechanics/joint_speeds.hpp"

#include <algorithm>

namespace cupola {

std::vector<JointSpeeds> joint_speeds(const Assembly& assembly, const Frame& frame,
                                      const JointWrenches& joints) {
  const BlockTable& blocks = frame.blocks;
  double fastest = 0.0;
  for (const Vec3& v : blocks.velocity) fastest = std::max(fastest, v.norm());
  const auto velocity = [&](int block, const Vec3& point) -> Vec3 {
    const Vec3& centroid =
        blocks.contact_position.empty() ? assembly.blocks[block].centroid : blocks.contact_position[block];
    return blocks.velocity[block] + blocks.angular_velocity[block].cross(point - centroid);
  };
  std::vector<JointSpeeds> speeds(joints.wrenches.size());
  if (fastest == 0.0) return speeds;
  for (size_t j = 0; j < speeds.size(); ++j) {
    const JointWrench& joint = joints.wrenches[j];
    for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
      const Vec3 &point = frame.contacts.point[joints.contacts[i]],
                 &normal = frame.contacts.normal[joints.contacts[i]];
      const Vec3 u = (velocity(joint.block_b, point) - velocity(joint.block_a, point)) / fastest;
      const double opening = u.dot(normal);
      speeds[j].add(opening, (u - opening * normal).norm());
    }
  }
  return speeds;
}

MechanismMotion mechanism_motion(const Assembly& assembly, const Frame& frame, const JointWrenches& joints) {
  const std::vector<JointSpeeds> speeds = joint_speeds(assembly, frame, joints);
  MechanismMotion motion;
  for (size_t i = 0; i < speeds.size(); ++i) {
    const JointWrench& j = joints.wrenches[i];
    const JointMotion how = speeds[i].motion();
    if (how == JointMotion::closed) continue;
    const bool parts = how == JointMotion::opening;
    ++(how == JointMotion::sliding ? motion.joints.sliding
       : parts                     ? motion.joints.opening
                                   : motion.joints.hinging);
    const auto [below, course] =
        std::minmax(assembly.blocks[j.block_a].ring, assembly.blocks[j.block_b].ring);
    const bool over = j.upper >= 0 && (j.carried < 0 || assembly.blocks[j.carried].fixed);
    CourseMotion& at = motion.by_course[{course, over}];
    const double opens = speeds[i].turning(), slides = speeds[i].sliding;
    (parts ? at.parting : at.hinging) += opens;
    at.sliding += slides;
    at.height += (opens + slides) * j.centroid.z();
    if (opens + slides > at.fastest) {
      at.fastest = opens + slides;
      at.on = below;
    }
  }
  for (auto& [course, at] : motion.by_course) {
    at.height /= at.sum();
    motion.hinging += at.hinging;
    motion.sliding += at.sliding;
    motion.parting += at.parting;
  }
  return motion;
}

}  // namespace cupola
