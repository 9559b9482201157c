#pragma once

#include <map>

#include "assembly/model/outward.hpp"
#include "assembly/model/results.hpp"

namespace cupola::verification {

/// Sum over the base of the radial components of the reactions, outwards on the support, N: see outward_at().
inline double outward_thrust(const Assembly& assembly, const ContactTable& contacts) {
  struct Base {
    Vec3 centroid = Vec3::Zero(), force = Vec3::Zero();
    double area = 0.0;
  };
  std::map<int, Base> joints;
  for (int i = 0; i < contacts.size(); ++i) {
    if (contacts.kind[i] != JointKind::base) continue;
    Base& joint = joints[contacts.joint[i]];
    joint.centroid += contacts.area[i] * contacts.point[i];
    joint.area += contacts.area[i];
    joint.force += (assembly.blocks[contacts.block_b[i]].fixed ? 1.0 : -1.0) * contacts.force[i];
  }
  double sum = 0.0;
  for (const auto& [number, joint] : joints)
    sum += joint.force.dot(outward_at(joint.centroid / joint.area, false));
  return sum;
}

}  // namespace cupola::verification
