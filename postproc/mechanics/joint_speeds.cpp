#include "postproc/mechanics/joint_speeds.hpp"

#include <algorithm>
#include <limits>

#include "postproc/mechanics/mechanism_motion.hpp"

namespace cupola {
namespace {

/// Velocity of the second block of a contact relative to the first, m/s: along the normal and across it.
struct Apart {
  double opening = 0.0, sliding = 0.0;
};
Apart apart_at(const Assembly& assembly, const Frame& frame, const JointWrench& joint, int contact) {
  const Vec3& point = frame.contacts.point[contact];
  const auto velocity = [&](int block) -> Vec3 {
    return frame.blocks.velocity[block] +
           frame.blocks.angular_velocity[block].cross(point - assembly.blocks[block].centroid);
  };
  const Vec3 u = velocity(joint.block_b) - velocity(joint.block_a);
  const Vec3& normal = frame.contacts.normal[contact];
  const double opening = u.dot(normal);
  return {opening, (u - opening * normal).norm()};
}

}  // namespace

JointSpeeds joint_speeds(const Assembly& assembly, const Frame& frame, const JointWrenches& joints,
                         size_t joint) {
  const JointWrench& j = joints.wrenches[joint];
  JointSpeeds speeds;
  for (int i = j.contact_start; i < j.contact_start + j.num_contacts; ++i) {
    const Apart apart = apart_at(assembly, frame, j, joints.contacts[i]);
    speeds.opening = std::max(speeds.opening, apart.opening);
    speeds.sliding = std::max(speeds.sliding, apart.sliding);
  }
  return speeds;
}

MechanismMotion mechanism_motion(const Assembly& assembly, const Frame& frame, const JointWrenches& joints,
                                 double friction) {
  constexpr double kMoves = 0.02;  // of the fastest block
  double fastest = 0.0;
  for (const Vec3& v : frame.blocks.velocity) fastest = std::max(fastest, v.norm());
  const double least = kMoves * fastest;
  MechanismMotion motion;
  for (const JointWrench& j : joints.wrenches) {
    Apart closest{std::numeric_limits<double>::infinity(), 0.0};  // where the joint opens least
    double widest = 0.0;
    for (int i = j.contact_start; i < j.contact_start + j.num_contacts; ++i) {
      const Apart apart = apart_at(assembly, frame, j, joints.contacts[i]);
      if (apart.opening < closest.opening) closest = apart;
      widest = std::max(widest, apart.opening);
    }
    const bool slides = closest.sliding > least && closest.opening <= friction * closest.sliding + least;
    const bool parts = !slides && closest.opening > least;
    if (!slides && !parts && widest <= least) continue;
    ++(slides ? motion.joints.sliding : parts ? motion.joints.opening : motion.joints.hinging);
    const double opens = std::max(widest - friction * closest.sliding, 0.0);
    const auto [below, course] =
        std::minmax(assembly.blocks[j.block_a].ring, assembly.blocks[j.block_b].ring);
    CourseMotion& at = motion.by_course[course];
    (parts ? at.parting : at.hinging) += opens;
    at.sliding += closest.sliding;
    if (opens + closest.sliding > at.fastest) {
      at.fastest = opens + closest.sliding;
      at.on = below;
    }
  }
  for (const auto& [course, at] : motion.by_course) {
    motion.hinging += at.hinging;
    motion.sliding += at.sliding;
    motion.parting += at.parting;
  }
  return motion;
}

}  // namespace cupola
