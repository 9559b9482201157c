#include "postproc/mechanics/plane_cut.hpp"

#include "assembly/base/error.hpp"
#include "postproc/mechanics/chain_forces.hpp"
#include "postproc/mechanics/shell.hpp"
#include "postproc/mechanics/stage_blocks.hpp"

namespace cupola {

Vec3 force_beyond(const PlaneCut& cut, const Assembly& assembly, const JointWrench& joint) {
  const int a = joint.block_a, b = joint.block_b;
  const Vec3 towards_b = assembly.blocks[b].centroid - assembly.blocks[a].centroid;
  return wrench_on(joint, cut.normal.dot(towards_b) > 0.0 ? b : a).force;
}

PlaneCut plane_cut(const CutPlane& plane, const Assembly& assembly, const JointWrenches& joints,
                   const Vec3& gravity, const std::vector<PointForce>& loads, const TieTable& ties,
                   const std::vector<bool>& left_out) {
  PlaneCut cut;
  cut.name = plane.name;
  cut.point = cut.across.point = plane.point;
  CUPOLA_ASSERT(plane.normal.norm() > 0.0);
  cut.normal = plane.normal.normalized();

  const double on_plane = on_plane_tolerance(assembly);
  const auto is_free = [&](int block) { return takes_part(assembly, block, left_out); };
  std::vector<bool> beyond(assembly.blocks.size());
  for (size_t b = 0; b < beyond.size(); ++b) {
    beyond[b] =
        is_free(static_cast<int>(b)) && cut.normal.dot(assembly.blocks[b].centroid - cut.point) > on_plane;
    if (beyond[b]) cut.load_beyond += assembly.blocks[b].mass * gravity;
  }
  for (const PointForce& load : loads)
    if (beyond[load.block]) cut.load_beyond += load.force;

  for (size_t j = 0; j < joints.wrenches.size(); ++j) {
    const JointWrench& joint = joints.wrenches[j];
    const int a = joint.block_a, b = joint.block_b;
    if (beyond[a] == beyond[b]) continue;
    const Wrench wrench = wrench_on(joint, beyond[b] ? b : a);
    if (!is_free(a) || !is_free(b)) {
      cut.from_supports += wrench.force;
    } else {
      cut.across.add(wrench);
      cut.joints.push_back(static_cast<int>(j));
    }
  }
  for (int i = 0; i < ties.size(); ++i) {
    const int a = ties.block_a[i], b = ties.block_b[i];
    if (beyond[a] == beyond[b]) continue;
    const Vec3 force = beyond[b] ? tie_force_on_b(ties, i) : Vec3(-tie_force_on_b(ties, i));
    (is_free(a) && is_free(b) ? cut.from_ties : cut.from_supports) += force;
  }
  if (cut.load_beyond.norm() > 0.0)
    cut.relative_difference =
        (cut.across.force + cut.from_ties + cut.from_supports + cut.load_beyond).norm() /
        cut.load_beyond.norm();
  return cut;
}

}  // namespace cupola
