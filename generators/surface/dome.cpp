#include "generators/surface/dome.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Volume between the radii r0 and r1 from the springing to angle t, m3; see dome.hpp.
double smooth_volume(double r0, double r1, double e, double t) {
  using std::numbers::pi;
  return 2.0 * pi * ((r1 * r1 * r1 - r0 * r0 * r0) / 3.0 * std::sin(t) - e * t / 2.0 * (r1 * r1 - r0 * r0));
}

}  // namespace

SurfaceMap dome_surface(const DomeSurface& dome, int rings) {
  using std::numbers::pi;
  const double R = dome.radius();
  const double e = dome.center_offset();
  const double crown = dome.crown_angle_deg * pi / 180.0;
  if (R * std::cos(crown) <= e)
    throw InputError(fmt::format(
        "geometry.surface.crown_angle_deg = {}: the intrados meets the axis at {:.6g} deg; choose a "
        "smaller angle",
        dome.crown_angle_deg, std::acos(e / R) * 180.0 / pi));

  SurfaceMap surface;
  surface.num_rows = rings;
  surface.extent = 2.0 * pi;
  surface.footing = Footing::ring;
  surface.shell_volume = smooth_volume(R, R + dome.thickness, e, crown);
  surface.at = [=](double bed, double azimuth, double depth) {
    const double t = crown * bed / rings;
    const double r = R + depth;
    const double rho = r * std::cos(t) - e;
    return Vec3(rho * std::cos(azimuth), rho * std::sin(azimuth), r * std::sin(t));
  };
  return surface;
}

}  // namespace cupola
