#include "generators/surface/faceted.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "generators/surface/make_surface.hpp"

namespace cupola {

SurfaceMap faceted(SurfaceMap surface, const std::vector<double>& ends) {
  CUPOLA_ASSERT(surface.closed && ends.size() > 3);
  if (!surface.shell_volume) surface.shell_volume = extrapolated_shell_volume(surface);
  surface.at = [ends, extent = surface.extent, at = surface.at](double bed, double abscissa,
                                                                double depth) -> Vec3 {
    const double azimuth = abscissa - extent * std::floor((abscissa - ends.front()) / extent);
    const auto above = std::upper_bound(ends.begin() + 1, ends.end() - 1, azimuth);
    const Vec3 left = at(bed, *(above - 1), depth), right = at(bed, *above, depth);
    const double c = std::cos(azimuth), s = std::sin(azimuth);
    const double from_left = c * left.y() - s * left.x(), from_right = c * right.y() - s * right.x();
    return left + from_left / (from_left - from_right) * (right - left);
  };
  surface.flat_slices = surface.flat_skins;
  surface.facets = ends;
  return surface;
}

}  // namespace cupola
