#include "generators/surface/window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/surface/azimuth.hpp"
#include "generators/surface/make_surface.hpp"
#include "generators/surface/secant.hpp"

namespace cupola {
namespace {

using std::numbers::pi;

/// Bed of the whole surface, as a fraction, where the intrados at a corner has the height of the window.
double bed_at_height(const SurfaceMap& whole, double height) {
  const auto residual = [&](double bed) { return whole.height(bed) - height; };
  const double crown = residual(whole.num_rows);
  if (crown <= 0.0)
    throw InputError(
        fmt::format("geometry.window.height = {}: must be below the crown, which is {:.6g} m high", height,
                    crown + height));
  const double guess = whole.num_rows * height / (height + crown);
  return secant_root(residual, guess, guess * (1.0 + 1e-3));
}

/// Beds of the whole surface per metre along the intrados at abscissa 0. The step keeps the errors of the
/// difference and of rounding below 1e-9.
double beds_per_metre(const SurfaceMap& whole, double bed) {
  const double step = 1e-4 * whole.num_rows;
  const auto at = [&](double b) { return whole.intrados(b, 0.0); };
  return 2.0 * step / (at(bed + step) - at(bed - step)).norm();
}

}  // namespace

SurfaceMap window_surface(const Surface& surface, std::vector<Thickness> wythes, const Window& window,
                          int courses, int built, double support_depth) {
  const SurfaceMap whole = make_surface(surface, courses, std::move(wythes));
  CUPOLA_ASSERT(whole.closed && whole.rows_per_ring == 1 && built >= 1 && built <= courses);
  const double under_last = bed_at_height(whole, window.height);
  const double per_metre = beds_per_metre(whole, under_last);
  const double first = under_last - (built - 1) * window.course * per_metre;
  const double step = window.course * per_metre;
  if (first < 0.0)
    throw InputError(
        fmt::format("geometry.window.height = {}: {} courses of {} m below it reach below the "
                    "springing; lay fewer courses (bond.rings) or choose a greater height",
                    window.height, built - 1, window.course));
  if (first + courses * step > whole.num_rows)
    throw InputError(fmt::format("geometry.window.height = {}: {} courses of {} m reach above the crown",
                                 window.height, courses, window.course));

  SurfaceMap map = whole;
  map.closed = false;
  map.first_row_held = true;
  map.shell_volume.reset();
  map.num_rows = courses + 1;
  const auto end_at = [&](double azimuth_deg) {
    const double azimuth = azimuth_deg * pi / 180.0;
    return abscissa_at([&](double a) { return whole.intrados(under_last, a); }, azimuth, azimuth);
  };
  const double from = end_at(window.from_deg);
  map.extent = end_at(window.to_deg) - from;
  map.first_corner = -from;
  map.corners.clear();
  const double rounding = 1e-9 * map.sail_width;
  if (map.sail_width > 0.0)
    for (double sail = std::ceil((from - rounding) / map.sail_width);; ++sail) {
      const double corner = sail * map.sail_width - from;
      if (corner > map.extent - rounding) break;
      map.corners.push_back(std::max(corner, 0.0));
    }
  const double radius = whole.intrados(under_last, 0.0).head<2>().norm();
  if (window.ends == Window::Ends::held)
    map.held_end = std::min(support_depth / radius, 0.5 * (2.0 * pi - map.extent));
  const double support = support_depth * per_metre;
  map.at = [=, at = whole.at](double bed, double abscissa, double depth) {
    const double b = bed < 1.0 ? first - (1.0 - bed) * support : first + (bed - 1.0) * step;
    return at(b, from + abscissa, depth);
  };
  return map;
}

}  // namespace cupola
