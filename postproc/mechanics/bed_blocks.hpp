#pragma once

#include <optional>
#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/poses.hpp"

namespace cupola {

/// Share of the thickness of the shell at a point in the plane of the bed, both as built, from its distances
/// to the inner and outer edges of the nearest facet.
double share_at(const std::vector<BedFacet>& bed, const BlockBed& block, const Vec3& x);

/// Normal forces on a bed, N, and their sum weighted by the shares of the thickness at which they act.
struct Bearing {
  double normal_force = 0.0, weighted_share = 0.0;
  double share() const { return normal_force != 0.0 ? weighted_share / normal_force : 0.0; }
};

/// Adds the contact points of a joint under (or, on the last bed, over) a block, each on the facet on which
/// it lies: the facets of a bonder across a corner lie in several planes, and a wythe may be thinner than the
/// bend between them is deep.
void add_bearing(const JointWrench& joint, const JointWrenches& joints, const ContactTable& contacts,
                 const std::vector<BedFacet>& bed, const BlockBed& block, const Poses& poses,
                 Bearing* bearing);

/// Shares of the thickness of the shell between which a line lies.
struct Layers {
  double inner = 0.0, outer = 1.0;
  /// Position between the layers, 0 to 1, of a point at this share of the thickness.
  double position(double share) const { return (share - inner) / (outer - inner); }
};

/// The layers of some wythes on a bed, or those between which something stands on it. None if they are not
/// known.
std::optional<Layers> layers_of(const Shell& shell, int bed, std::optional<WytheRange> wythes);

}  // namespace cupola
