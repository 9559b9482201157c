#pragma once

#include <array>
#include <cstdint>
#include <variant>

#include "assembly/base/named_enum.hpp"
#include "assembly/case/vault_surface.hpp"

namespace cupola {

/// Dome of revolution with the pointed-fifth profile: two arcs of radius `radius_ratio * span`, centred
/// beyond the axis so that the springing lies `span / 2` from it.
struct DomeSurface {
  SurfaceTraits traits() const { return {.closed = true, .thrust_lines = Sheet::ThrustLines::by_azimuth}; }

  double span = 45.0;             ///< m, > 0, clear diameter at the springing
  double radius_ratio = 0.8;      ///< intrados radius over span, >= 0.5 (0.5: hemisphere, 0.8: pointed fifth)
  double thickness = 2.2;         ///< m, > 0
  double crown_angle_deg = 60.0;  ///< angle t of the last bed, in (0, 90)

  double radius() const { return radius_ratio * span; }         ///< R, m
  double center_offset() const { return radius() - span / 2; }  ///< e, m
};

/// Plane wall, x along the length, y across, z up.
struct WallSurface {
  SurfaceTraits traits() const { return {.closed = false, .thrust_lines = Sheet::ThrustLines::none}; }

  double length = 12.0;    ///< m, > 0
  double height = 6.0;     ///< m, > 0
  double thickness = 1.0;  ///< m, > 0
};

/// Cloister vault over a regular polygon (an octagon by default): each sail is a cylinder, and the section
/// through two opposite corners is the pointed-fifth profile of the dome.
struct OctagonalVault {
  SurfaceTraits traits() const { return {.closed = true, .thrust_lines = Sheet::ThrustLines::by_azimuth}; }

  /// Beds on cones about the axis, as Brunelleschi laid them; in planes normal to each sail; level.
  enum class Construction : std::uint8_t { circular, planar_radial, planar_horizontal };
  /// Where `thickness` is measured: normal to the sail; on the corner section, whose extrados is a second
  /// arc; on the mid-sail section, whose extrados is a second arc; along level beds.
  enum class Extrados : std::uint8_t { normal, corner, midsail, bed };

  int sails = 8;                  ///< >= 3
  double span = 45.0;             ///< m, > 0, clear distance of opposite corners at the springing
  double radius_ratio = 0.8;      ///< radius of the corner arc over span, >= 0.5
  double thickness = 2.2;         ///< m, > 0
  double crown_angle_deg = 60.0;  ///< angle of the last bed at the corner, in (0, 90)
  Construction construction = Construction::circular;
  Extrados extrados = Extrados::normal;

  double radius() const { return radius_ratio * span; }         ///< R, m
  double center_offset() const { return radius() - span / 2; }  ///< e, m
};
constexpr auto enum_names(OctagonalVault::Construction) {
  return std::array{"circular", "planar_radial", "planar_horizontal"};
}
constexpr auto enum_names(OctagonalVault::Extrados) {
  return std::array{"normal", "corner", "midsail", "bed"};
}

/// Barrel arch of two arcs with radial joints, from one springing over the crown (x = 0) to the other; its
/// axis is y. A pointed arch (radius_ratio > 0.5) has a joint in the crown plane.
struct ArchSurface {
  SurfaceTraits traits() const { return {.closed = false, .thrust_lines = Sheet::ThrustLines::one}; }

  double span = 10.0;              ///< m, > 0, clear span of the full arc at z = 0: 2 R when semicircular
  double radius_ratio = 0.5;       ///< intrados radius over span, >= 0.5 (0.5: one circle)
  double thickness = 1.0;          ///< m, > 0
  double width = 1.0;              ///< m, > 0, along the axis
  double half_embrace_deg = 90.0;  ///< at the centre of each arc, from the vertical to the springing
  /// Straight segments that approximate the curved faces of a voussoir. With n segments the relative error of
  /// the volume is (angle/n)^2 / 6; 1 gives polygonal voussoirs.
  int voussoir_segments = 1;

  double radius() const { return radius_ratio * span; }         ///< R, m
  double center_offset() const { return radius() - span / 2; }  ///< e, m
};

using Surface = std::variant<DomeSurface, OctagonalVault, ArchSurface, WallSurface, VaultSurface>;

inline SurfaceTraits traits_of(const Surface& surface) {
  return std::visit([](const auto& kind) { return kind.traits(); }, surface);
}

}  // namespace cupola
