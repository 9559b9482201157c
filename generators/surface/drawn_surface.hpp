#pragma once

#include "generators/surface/profile.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// A profile carried along a plan. The profile runs from the first bed to the last in the (r, z) plane; r is
/// the distance from the z axis, or from the plane of symmetry of a barrel. Depths are measured along its
/// normal, outwards.
struct Drawing {
  std::vector<ProfilePiece> profile;
  Plan plan;
  VaultSurface::Beds beds = VaultSurface::Beds::normal;
  std::vector<double> bed_angles_deg = {};  ///< see VaultSurface
  VaultSurface::Courses courses = VaultSurface::Courses::length;
  OctagonalVault::Extrados extrados = OctagonalVault::Extrados::normal;
  double drawn_depth = 0.0;  ///< m, of the drawn line behind the intrados
  double thickness = 0.0;    ///< m, of the whole shell at the springing
  int rows_per_ring = 1;
  bool key_stone = false;  ///< see SurfaceMap
  bool mirrored = false;   ///< the second half of the profile mirrors the first
};

/// The surface of a drawing.
///
/// - Line: the point (r, z) becomes (r, y, z) with the abscissa y, or (x, -r, z) with the abscissa x.
/// - Groin: one of the webs, (r, y, z) with the abscissa y from 0, at the axis, to the side. It is uncut; see
///   generators/stereotomy/groin_vault.hpp.
/// - Circle: (r cos a, r sin a, z), a the abscissa. Every bed is a cone about the z axis, so that its facets
///   between radial half-planes are plane.
/// - Polygon: each sail is a cylinder whose section normal to its side is the profile, or that of a regular
///   polygon whose corner section is the profile. `normal` and `level` beds are plane in each sail, and the
///   abscissa divides each side into equal parts; the head planes are vertical. `conical` beds are cones
///   about the z axis through the normals of the corner section, and the abscissa is the azimuth. At azimuth
///   psi from mid-sail the bed meets the layer where
///       (x / cos psi - r_k) n_z = (z - z_k) n_r,
///   (x, z) on the layer's mid-sail section, (r_k, z_k) on the corner section with its normal n. z is then
///   computed from the bed, so that bed facets are plane to rounding.
///
/// `given` beds are as `normal` ones, at their angles.
///
/// A kink of the profile is a bed in the bisector of its two normals; conical beds have none.
///
/// `shell_volume` is known where beds are plane in each sail, or cones over a circle: the integral of the
/// circumference, which is linear in r, over the section.
SurfaceMap drawn_surface(const Drawing& drawing, int rings);

}  // namespace cupola
