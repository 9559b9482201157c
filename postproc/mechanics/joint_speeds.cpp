#include "postproc/mechanics/joint_speeds.hpp"

#include <algorithm>

namespace cupola {

JointSpeeds joint_speeds(const Assembly& assembly, const Frame& frame, const JointWrenches& joints,
                         size_t joint) {
  const ContactTable& contacts = frame.contacts;
  const BlockTable& blocks = frame.blocks;
  const auto velocity_at = [&](int block, const Vec3& point) -> Vec3 {
    return blocks.velocity[block] +
           blocks.angular_velocity[block].cross(point - assembly.blocks[block].centroid);
  };
  const JointWrench& j = joints.wrenches[joint];
  JointSpeeds speeds;
  for (int i = j.contact_start; i < j.contact_start + j.num_contacts; ++i) {
    const int c = joints.contacts[i];
    const Vec3 u = velocity_at(j.block_b, contacts.point[c]) - velocity_at(j.block_a, contacts.point[c]);
    const double apart = u.dot(contacts.normal[c]);
    speeds.opening = std::max(speeds.opening, apart);
    speeds.sliding = std::max(speeds.sliding, (u - apart * contacts.normal[c]).norm());
  }
  return speeds;
}

}  // namespace cupola
