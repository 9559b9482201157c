#pragma once

#include <vector>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/shell.hpp"

namespace cupola {

/// The convex body that a cut of its own outline takes, in the coordinates of its member: n.x <= offset for
/// all planes.
std::vector<Plane> body_of(const Cut& cut);

/// What lies under the facets of a barrel, between its two ends and down without end, in its own coordinates;
/// above the springings between the vertical planes through them. Throws InputError that begins with `key`
/// for a section that is not convex or reaches beyond these planes.
std::vector<Plane> body_under(const Storey& barrel, Cut::Face face, const std::string& key);

/// What lies over the intrados of the webs of a groin vault, in its own coordinates: a body for each facet,
/// between the planes of the groins. Below the first beds their supports continue the intrados.
std::vector<std::vector<Plane>> bodies_over(const Storey& vault);

/// The plane of a groin of the web behind the side y = apothem, on its right (0) or left (1) side, seen from
/// the axis; what lies beyond it is lost.
Cut groin_cut(int webs, int side);

/// Planes after a motion.
std::vector<Plane> moved(std::vector<Plane> planes, const Eigen::Isometry3d& placement);

}  // namespace cupola
