#pragma once

#include <optional>
#include <span>
#include <vector>

#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// The facet of a bed that a cut has left without an inner or an outer edge, as a triangle at a groin or the
/// back of a rib under its web: the rectangle around the corners in the plane with the given normal.
/// `outwards`: through the thickness, need not lie in the plane. None if it is normal to it.
std::optional<BedFacet> facet_around(int block, std::span<const Vec3> corners, const Vec3& normal,
                                     const Vec3& outwards);

/// A face of a bed and its part.
struct BedFace {
  const Part* part = nullptr;
  int face = 0;
};

/// Adds such facets to a bed for the faces of blocks without facets on it. The thickness of a part runs from
/// its intrados to its extrados, of one without either as in the rest of its block.
void add_cut_facets(const Assembly& assembly, std::span<const BedFace> faces, std::vector<BedFacet>* bed);

/// The direction in which a value at the corners grows, by least squares; zero if it does not.
Vec3 growth(std::span<const Vec3> corners, std::span<const double> values);

}  // namespace cupola
