#pragma once

#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola::verification {

/// Sum over the base of the radial components of the reactions, outwards on the support, N. The radius is
/// that of the contact point.
inline double outward_thrust(const Assembly& assembly, const ContactTable& contacts) {
  double sum = 0.0;
  for (int i = 0; i < contacts.size(); ++i) {
    if (contacts.kind[i] != JointKind::base) continue;
    const Vec3 outwards = Vec3(contacts.point[i].x(), contacts.point[i].y(), 0.0).normalized();
    const double on_b = contacts.force[i].dot(outwards);
    sum += assembly.blocks[contacts.block_b[i]].fixed ? on_b : -on_b;
  }
  return sum;
}

}  // namespace cupola::verification
