#include "solver/collision/oriented_box.hpp"

#include <fcl/math/bv/OBB.h>

namespace cupola {

Eigen::AlignedBox3d bounding_box(const OrientedBox& box) {
  const Vec3 half = box.axes.cwiseAbs() * box.half_sizes;
  return {box.center - half, box.center + half};
}

bool overlap(const OrientedBox& a, const OrientedBox& b) {
  return !fcl::obbDisjoint<double>(a.axes.transpose() * b.axes, a.axes.transpose() * (b.center - a.center),
                                   a.half_sizes, b.half_sizes);
}

}  // namespace cupola
