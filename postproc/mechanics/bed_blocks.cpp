#include "postproc/mechanics/bed_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace cupola {

double share_at(const std::vector<BedFacet>& bed, const BlockBed& block, const Vec3& x) {
  const BedFacet* facet = &bed[block.facets.front()];
  double nearest = std::numeric_limits<double>::infinity();
  for (const int i : block.facets) {
    const BedFacet& f = bed[i];
    const double distance =
        (0.25 * (f.intrados_a + f.intrados_b + f.extrados_a + f.extrados_b) - x).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      facet = &f;
    }
  }
  const auto from_edge = [&](const Vec3& a, const Vec3& b, const Vec3& inside) {
    const Vec3 along = (b - a).normalized();
    const auto rejection = [&](const Vec3& p) { return Vec3(p - a - along.dot(p - a) * along); };
    return rejection(x).dot(rejection(inside).normalized());
  };
  const double inner = from_edge(facet->intrados_a, facet->intrados_b, facet->extrados_a);
  const double outer = from_edge(facet->extrados_a, facet->extrados_b, facet->intrados_a);
  return facet->from + inner / (inner + outer) * (facet->to - facet->from);
}

void add_bearing(const JointWrench& joint, const JointWrenches& joints, const ContactTable& contacts,
                 const std::vector<BedFacet>& bed, const BlockBed& block, const Poses& poses,
                 Bearing* bearing) {
  for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
    const int row = joints.contacts[i];
    const double normal = contacts.normal_force[row];
    bearing->normal_force += normal;
    const Vec3 at = poses.as_built(block.block, contacts.point[row]);
    bearing->weighted_share += normal * share_at(bed, block, at);
  }
}

std::optional<Layers> layers_of(const Shell& shell, int bed, std::optional<WytheRange> wythes) {
  const std::vector<BedFacet>& facets = shell.beds[bed];
  if (facets.empty()) return std::nullopt;
  if (!wythes)
    return Layers{std::ranges::min(facets, {}, &BedFacet::from).from,
                  std::ranges::max(facets, {}, &BedFacet::to).to};
  const Layers layers{shell.layers[bed][wythes->from], shell.layers[bed][wythes->to]};
  return std::isfinite(layers.inner + layers.outer) ? std::optional(layers) : std::nullopt;
}

}  // namespace cupola
