#pragma once

#include <memory>
#include <vector>

#include "generators/surface/profile.hpp"

namespace cupola {

/// Outwards of a profile that is drawn from the springing upwards.
Vec2 outward_normal(const Vec2& derivative);

/// The sections of a sail: the corner section is (corner r, z), the section normal to the side (middle r, z).
struct SailSection {
  std::shared_ptr<const ProfileBeds> beds;
  double corner = 1.0, middle = 1.0;  ///< factors on r
  OctagonalVault::Extrados extrados = OctagonalVault::Extrados::normal;
  double drawn_depth = 0.0;
  std::vector<double> bed_angles = {};  ///< rad, of given beds
  double num_rows = 0.0;
  bool mirrored = false;

  /// The point of a bed at its place on the drawn line of the section with a factor on r.
  Vec2 point(double bed, double place, double factor) const;
  /// Normal of that section; at a kink the bisector.
  Vec2 normal_of(double bed, double place, double factor) const;
  /// Direction of a given bed outwards.
  Vec2 given_direction(double bed) const;
  /// On the section normal to the side, at a place on a run and a depth (m) behind the intrados.
  Vec2 layer(double place, int run, double from_intrados) const;
  /// The run whose layer a bed in a given direction meets: at a kink the layers of the two runs meet on the
  /// bisector.
  int run_met(double bed, double place, const Vec2& along, double from_intrados) const;
};

/// The point of a bed that is plane in each sail: where a line through the bed on the drawn line meets the
/// layer.
Vec2 plane_bed_point(const SailSection& section, VaultSurface::Beds beds, double bed, double depth);

/// The integral of at_axis + per_r r over the section normal to the side, between the first bed, the last bed
/// and two layers, which go on to the bisectors of the kinks.
double section_integral(const SailSection& section, VaultSurface::Beds beds, double thickness, double at_axis,
                        double per_r);

/// The point of a conical bed at q = 1 / cos psi: its distance from the axis and its height.
Vec2 conical_bed_point(const SailSection& section, double bed, double depth, double q);

}  // namespace cupola
