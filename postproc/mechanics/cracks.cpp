#include "postproc/mechanics/cracks.hpp"

#include <algorithm>

namespace cupola {

std::vector<Crack> cracks_of(const ContactTable& c, const JointWrenches& joints) {
  std::vector<Crack> cracks;
  for (size_t j = 0; j < joints.wrenches.size(); ++j) {
    const JointWrench& joint = joints.wrenches[j];
    std::vector<Vec3> open;
    double widest = 0.0;
    for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
      const int row = joints.contacts[i];
      // A joint that pulls elongates elastically before it cracks.
      const double opening = c.crack_opening.empty() ? c.gap[row] : c.crack_opening[row];
      if (c.normal_force[row] > joints.floor.force || opening <= joints.floor.length) continue;
      open.push_back(c.point[row]);
      widest = std::max(widest, opening);
    }
    if (open.empty()) continue;
    cracks.push_back({static_cast<int>(j), planar_hull(open, joint.patch.plane.normal), widest});
  }
  return cracks;
}

}  // namespace cupola
