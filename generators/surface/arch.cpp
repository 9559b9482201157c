#include "generators/surface/arch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

using std::numbers::pi;

/// Angle t at which the arc of radius r, whose centre lies e beyond the plane x = 0, reaches that plane.
double crown_angle(double r, double e) {
  return std::acos(e / r);
}

/// Area between the arcs of radius r0 and r1 of one half, from angle t0 to the plane x = 0, m2.
double half_area(double r0, double r1, double e, double t0) {
  const auto under = [&](double r) {  // sector from t0 to the crown less the triangle beyond x = 0
    const double t = crown_angle(r, e);
    return 0.5 * r * r * (t - t0) - 0.5 * e * r * std::sin(t);
  };
  return under(r1) - under(r0);
}

}  // namespace

SurfaceMap arch_surface(const ArchSurface& arch, int rings) {
  const double R = arch.radius();
  const double e = arch.center_offset();
  const double springing = pi / 2 - arch.half_embrace_deg * pi / 180.0;
  if (e > 0.0 && rings % 2 != 0)
    throw InputError(fmt::format(
        "geometry.bond.rings = {}: must be even, because a pointed arch has a joint at the crown", rings));
  if (springing >= crown_angle(R, e))
    throw InputError(fmt::format(
        "geometry.surface.half_embrace_deg = {}: must be > {:.6g}, where the arc reaches the crown",
        arch.half_embrace_deg, 90.0 - crown_angle(R, e) * 180.0 / pi));
  const double opening = 2.0 * (R * std::cos(springing) - e);
  if (opening < arch.thickness)
    throw InputError(
        fmt::format("geometry.surface.half_embrace_deg = {}: the springings are {:.3g} m apart, less than "
                    "the thickness of {} m, which is no vault. The angle counts at the centre of each arc, "
                    "from the vertical to the springing: 90 for a semicircle",
                    arch.half_embrace_deg, std::max(opening, 0.0), arch.thickness));

  SurfaceMap surface;
  surface.rows_per_ring = arch.voussoir_segments;
  surface.num_rows = rings * arch.voussoir_segments;
  surface.extent = arch.width;
  surface.flat_slices = true;
  surface.footing = Footing::both_springings;
  surface.carries = true;
  surface.shell_volume = 2.0 * arch.width * half_area(R, R + arch.thickness, e, springing);
  surface.at = [=, num_beds = surface.num_rows](double bed, double y, double depth) {
    const double r = R + depth;
    const bool mirrored = 2.0 * bed > num_beds;
    const double fraction = 2.0 * (mirrored ? num_beds - bed : bed) / num_beds;  // 0 springing, 1 crown
    if (fraction == 1.0) return Vec3(0.0, y, r * std::sin(crown_angle(r, e)));
    const double t = springing + (crown_angle(R, e) - springing) * fraction;
    const double x = -e + r * std::cos(t);
    return Vec3(mirrored ? -x : x, y, r * std::sin(t));
  };
  return surface;
}

}  // namespace cupola
