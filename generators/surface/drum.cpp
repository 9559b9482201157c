#include "generators/surface/drum.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"

namespace cupola {

SurfaceMap drum_surface(const SurfaceMap& shell, double height, std::vector<Thickness> wythes, int rings) {
  CUPOLA_ASSERT(shell.closed && std::abs(shell.intrados(0.0, 0.0).z()) == 0.0);
  SurfaceMap drum;
  drum.wythes = std::move(wythes);
  drum.num_rows = rings;
  drum.closed = true;
  drum.thrust_lines = shell.thrust_lines;
  drum.extent = shell.extent;
  drum.corners = shell.corners;
  drum.sail_width = shell.sail_width;
  drum.first_corner = shell.first_corner;
  drum.datum = -height;
  drum.flat_slices = !shell.corners.empty();
  drum.flat_rings = std::ranges::all_of(drum.wythes, &Thickness::constant);
  drum.carries = true;
  drum.at = [=, plan = shell.at](double bed, double abscissa, double depth) {
    Vec3 point = plan(0.0, abscissa, depth);
    point.z() = height * (bed / rings - 1.0);
    return point;
  };
  return drum;
}

}  // namespace cupola
